# The project's front door: every target installs what is missing, builds what has changed, and then does its work.
# A Python or a ROS workspace of the user's must not get into the build, hence the bare environment.
export PATH := /usr/bin:/bin
unexport MAKEFLAGS CMAKE_PREFIX_PATH ROS_PACKAGE_PATH PYTHONPATH LD_LIBRARY_PATH

# catkin and ROS write to HOME; without a usable one they write into the workspace.
ifneq ($(shell test -d "$$HOME" -a -w "$$HOME" && echo usable),usable)
export HOME := $(CURDIR)/catkin_ws/logs/home
$(shell mkdir -p $(HOME))
endif

.PHONY: build test shared-data cuts demo bench evaluate figures corpus validation tidy format clean help dependencies

build: dependencies  ## build everything; afterwards: . catkin_ws/devel/setup.bash
	scripts/build

test: dependencies  ## build, then run unit tests, rostests, launch file checks, walls, install space, catkin_lint and format
	scripts/build
	scripts/build tests
	scripts/run_tests

shared-data: dependencies  ## the tests on meshes, photographs and a toy's recording by others, in ../shared/data
	scripts/build
	scripts/build tests
	scripts/checks/shared_data

cuts: dependencies  ## 10,000 random cuts of sponge, torus, spot and the toy of ../shared/data (slow); make test makes a few
	scripts/build
	scripts/build tests
	scripts/cuts

demo: build  ## follow a virtual sponge: in rviz with a display, otherwise with pictures and figures in demo_output/
	scripts/demo

bench: build  ## run the benchmarks; writes bench/summary.json
	scripts/bench

corpus: build  ## prepare a model of every mesh of ../shared/data, and feed the readers 60,000 damaged files
	scripts/corpus

evaluate: build  ## accuracy over all scenes; writes docs/evaluation.md. SCENES="bend cut": only these, nothing written
	scripts/evaluate $(SCENES)

figures: build  ## the paper's Figures 10 and 11 with our models, in docs/images
	scripts/figures

validation: build  ## the simulator against known solutions; writes docs/validation.md
	scripts/validate

tidy: build  ## clang-tidy over all sources (slow)
	scripts/install_dependencies scripts/apt-packages-tidy.txt
	scripts/tidy

format: dependencies  ## clang-format all sources in place
	find src -name '*.h' -o -name '*.cpp' | xargs clang-format -i

clean:  ## remove everything that was built or written
	rm -rf catkin_ws/build catkin_ws/devel catkin_ws/install catkin_ws/logs catkin_ws/.catkin_tools
	rm -rf bench demo_output evaluation validation

help:  ## this list
	@sed -n 's/^\([a-z-]*\):.*##  *\(.*\)/\1\t\2/p' Makefile | expand -t 14

dependencies:
	@scripts/install_dependencies scripts/apt-packages.txt
