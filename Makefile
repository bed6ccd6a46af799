# The project's front door: every target installs what is missing, builds what has changed, and then does its work.
# SYSTEM=no: nothing is installed, and /etc/hosts stays as it is.
# A Python or a ROS workspace of the user's must not get into the build, hence the bare environment.
export PATH := /usr/bin:/bin
unexport MAKEFLAGS CMAKE_PREFIX_PATH ROS_PACKAGE_PATH PYTHONPATH LD_LIBRARY_PATH

# catkin and ROS write to HOME; without a usable one they write into the workspace.
ifneq ($(shell test -d "$$HOME" -a -w "$$HOME" && echo usable),usable)
export HOME := $(CURDIR)/catkin_ws/logs/home
$(shell mkdir -p $(HOME))
endif

.PHONY: build development test shared-data recordings meshes cuts demo bench fuzz evaluate starts latency scans figures paper validation growth
.PHONY: sanitize soak reload rviz-loop parameter-tables api tidy format
.PHONY: clean help dependencies

build: dependencies  ## build everything; afterwards: . catkin_ws/devel/setup.bash
	scripts/build

development: build  ## build benchmarks and the other programs that only make targets use
	scripts/build development

test: dependencies  ## build and run all checks: unit tests, rostests, launch files, package borders, install space, lint, format
	scripts/build
	scripts/build tests
	scripts/run_tests

shared-data: dependencies  ## run the tests on meshes, photographs and a toy recording of other projects, in ../shared/data
	scripts/build
	scripts/build tests
	scripts/checks/shared_data

recordings: dependencies  ## change a recording in 200 ways: validate_bag must say usable exactly when replay and evaluate work
	scripts/build
	scripts/build tests
	scripts/checks/recordings

meshes: dependencies  ## prepare 100 meshes with defects and check verdict, volume, cuts and time; also those of ../shared/data
	scripts/build
	scripts/build tests
	catkin_ws/devel/env.sh catkin_ws/devel/lib/development/softbody_sim/check_meshes $(or $(SEED),1) $(wildcard ../shared/data)

cuts: dependencies  ## cut sponge, torus, spot and the toy of ../shared/data 10,000 times at random, and measure the memory of cut bodies (slow)
	scripts/build
	scripts/build tests
	scripts/soaking/reliability "make cuts" scripts/cuts

demo: build  ## track a virtual sponge: in rviz with a display, otherwise with pictures and values in demo_output/
	catkin_ws/devel/env.sh rosrun softbody_bringup demo

bench: development  ## run the benchmarks; writes bench/summary.json and docs/measured/benchmarks.md
	scripts/bench

fuzz: development  ## give 1,000,000 mutated messages to every node, and 1,000,000 mutated files to all readers. MESSAGES=1000 FILES=1000: a short run
	scripts/install_dependencies scripts/optional_packages/fuzz.txt
	scripts/soaking/reliability $(if $(MESSAGES)$(FILES),--print) "make fuzz" scripts/fuzz

evaluate: build  ## measure all scenes and write docs/evaluation.md. SCENES="bend cut": only these scenes, writes nothing
	scripts/evaluate $(SCENES)

starts: build  ## start tracking on 100 layouts of cluttered scenes; writes docs/measured/starts.md
	cd scripts && /usr/bin/python3 -m evaluation.starts $(SCENES)

latency: build  ## measure latency and CPU times of the live graph in 32 ways (12 minutes); writes docs/latency.md
	cd scripts && /usr/bin/python3 -m evaluation.latency $(SCENES)

scans: build  ## scan virtual bodies and faulty recordings, track with the models; writes docs/measured/scans.md. KEEP=yes: keeps the recordings
	cd scripts && /usr/bin/python3 -m evaluation.scans $(if $(KEEP),--keep) $(SCENES)

figures: build  ## draw the paper's Figures 1 to 11 with our models, in docs/images
	scripts/paper figures

paper: development  ## measure the paper's accuracy, tables and times beside ours; writes docs/paper.md. PARTS="times": prints only that part
	scripts/paper $(PARTS)

validation: build  ## compare the simulator with known solutions; writes docs/validation.md
	scripts/validate

growth: development  ## measure how time and memory grow with tets, pieces, vertices, pixels and features; writes docs/growth.md
	scripts/growth

sanitize: dependencies  ## build with sanitizers (address and undefined, thread) and run tests, replay and the live graph (hours)
	scripts/soaking/reliability $(if $(PARTS),--print) "make sanitize" scripts/sanitize

soak: build  ## run two live graphs for SOAK_MINUTES=60 with faults, cuts and killed nodes. KILLS=500: until 500 kills, one every 3 s
	bash -c '. catkin_ws/devel/setup.bash && exec scripts/soaking/reliability $(if $(SOAK_MINUTES),--print) "make soak$(KILLS:%= KILLS=%)" \
	  scripts/soak --minutes $(or $(SOAK_MINUTES),60) $(KILLS:%=--kills %)'

reload: dependencies  ## load and unload all nodelets ROUNDS=200 times in one manager: its threads and its memory must not grow
	scripts/build
	scripts/build tests
	LOAD_ROUNDS=$(or $(ROUNDS),200) scripts/soaking/reliability $(if $(ROUNDS),--print) "make reload" \
	  scripts/soaking/rostest_lines src/softbody_bringup/test/restart/load_unload.test "[0-9]+ rounds: .*"

rviz-loop: build  ## run rviz for RVIZ_MINUTES=10 beside a bag that is played in a loop: it must go on drawing
	bash -c '. catkin_ws/devel/setup.bash && exec scripts/soaking/reliability $(if $(RVIZ_MINUTES),--print) "make rviz-loop" \
	  scripts/soaking/rviz_loop $(or $(RVIZ_MINUTES),10)'

parameter-tables: build  ## write the tables of parameters in docs/ from the nodes
	. catkin_ws/devel/setup.sh && scripts/checks/parameter_tables

api:  ## write pages of all public headers to api/html with doxygen; fails if it warns
	scripts/install_dependencies scripts/optional_packages/api.txt
	scripts/api

tidy: build  ## run clang-tidy on all sources except tests (slow)
	scripts/install_dependencies scripts/optional_packages/tidy.txt
	scripts/tidy

format: dependencies  ## format all sources in place with clang-format
	find src -name '*.h' -o -name '*.cpp' | xargs clang-format -i

clean:  ## remove everything that was built or written
	rm -rf catkin_ws/build* catkin_ws/devel* catkin_ws/install* catkin_ws/logs* catkin_ws/.catkin_tools
	rm -rf api bench demo_output evaluation soak validation

help:  ## this list
	@sed -n 's/^\([a-z-]*\):.*##  *\(.*\)/\1\t\2/p' Makefile | expand -t 14

dependencies:
	@scripts/install_dependencies scripts/apt-packages.txt
