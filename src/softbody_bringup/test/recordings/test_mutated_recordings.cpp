#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "recordings/mutations.h"
#include "softbody_evaluation/ros/evaluator.h"
#include "softbody_recordings/ros/facts_reader.h"
#include "softbody_recordings/ros/object_trial.h"
#include "softbody_recordings/ros/replay.h"
#include "softbody_recordings/validation/checks.h"

namespace softbody::recordings {
namespace {

const std::string kBag = ROSBAGS_DIR "/bend_small.bag", kObject = CONFIG_DIR "/sponge.yaml";
constexpr std::size_t kFrames = 18;  // 0.6 s: the sponge moves, and a run takes a second
constexpr int kQuick = 10;           // recordings in make test
constexpr double kMost_m = 2.56e-3;  // the goal of make evaluate for the sponge
// Of the error without a mutation: pixels that are rounded or interpolated change it by less, a lens that is
// removed twice by more.
constexpr double kMostErrors = 3.0;
constexpr double kFewestTracked = 0.6;  // of the frames: mutations lose up to a third of the images

std::vector<Mutation> allMutations() {
  std::vector<Mutation> all = cameraMutations();
  for (const auto& more : {lensMutations(), deliveryMutations()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// What the tools make of a recording.
struct Verdicts {
  bool usable = false;
  double error_m = -1.0;  ///< mean error of the surface; below 0: replay or evaluate failed
  double tracked = 0.0;   ///< share of the frames with a surface
  std::string validation, failure;
};

/// The tools' runs in a folder of their own.
class Tools {
 public:
  Tools() : folder_(std::filesystem::temp_directory_path() / fmt::format("recordings_{}", ::getpid())) {
    std::filesystem::create_directories(folder_);
  }
  ~Tools() { std::filesystem::remove_all(folder_); }

  Verdicts run(const Recording& recording) const {
    const std::string bag = (folder_ / "recording.bag").string(), result = (folder_ / "result.bag").string();
    writeRecording(recording, bag);
    std::filesystem::remove(result);
    Verdicts verdicts;
    validate(bag, recording, &verdicts);
    try {
      track(bag, result, recording, &verdicts);
    } catch (const std::exception& error) {
      verdicts.failure = error.what();
    }
    return verdicts;
  }

 private:
  static void validate(const std::string& bag, const Recording& recording, Verdicts* verdicts) try {
    BagFramesConfig config;
    config.camera = recording.options;
    validation::RecordingFacts facts = validation::readFacts(bag, config, [](double) {});
    if (facts.frames.with_depth > 0)
      facts.trial = tryObject(bag, config, kObject, FileScope::kOwnFolder, [](double) {});
    const validation::Findings findings = validation::check(facts);
    verdicts->usable = validation::usable(findings);
    verdicts->validation = validation::toText(facts, findings);
  } catch (const std::exception& error) {
    verdicts->validation = error.what();
  }

  static void track(const std::string& bag, const std::string& result, const Recording& recording,
                    Verdicts* verdicts) {
    ReplayOptions options;
    options.input = bag;
    options.objects = {kObject};
    options.output = result;
    options.camera = recording.options;
    const ReplaySummary summary = replay(
        options, [](const std::string&) {}, [](double) {});
    verdicts->tracked =
        static_cast<double>(summary.bodies.front().states) / static_cast<double>(recording.frames.size());
    evaluation::EvaluatorOptions measure;
    measure.result = result;
    measure.truth = measure.recording = bag;
    measure.camera = recording.options;
    const evaluation::Report report = evaluation::evaluate(measure);
    if (report.vertex_error && report.residual && std::isfinite(report.residual->residual.mean))
      verdicts->error_m = report.vertex_error->all.mean;
  }

  std::filesystem::path folder_;
};

class MutatedRecordings : public ::testing::Test {
 protected:
  void SetUp() override {
    const Verdicts verdicts = tools_.run(recording_);
    ASSERT_TRUE(verdicts.usable) << verdicts.validation;
    ASSERT_GE(verdicts.error_m, 0.0) << verdicts.failure;
    usual_m_ = verdicts.error_m;
  }

  static bool works(const Verdicts& verdicts) {
    return verdicts.error_m >= 0.0 && verdicts.error_m <= kMost_m && verdicts.tracked >= kFewestTracked;
  }

  /// validate_bag says usable exactly when the other tools work, and that is as expected.
  void expectAgreement(const std::vector<const Mutation*>& mutations, Random* random) {
    Recording recording = recording_;
    std::string names;
    bool expected = true, lossy = false;
    for (const Mutation* mutation : mutations) {
      mutation->apply(&recording, random);
      names += (names.empty() ? "" : " + ") + mutation->name;
      expected = expected && mutation->works;
      lossy = lossy || mutation->lossy;
    }
    const Verdicts verdicts = tools_.run(recording);
    const std::string story = fmt::format("{}: error {:.2f} mm, usually {:.2f}, tracked {:.0f} % {}\n{}",
                                          names, 1e3 * verdicts.error_m, 1e3 * usual_m_,
                                          100.0 * verdicts.tracked, verdicts.failure, verdicts.validation);
    EXPECT_EQ(verdicts.usable, works(verdicts)) << story;
    EXPECT_EQ(verdicts.usable, expected) << story;
    EXPECT_TRUE(!expected || lossy || verdicts.error_m <= kMostErrors * usual_m_) << story;
  }

  Tools tools_;
  Recording recording_ = readRecording(kBag, kFrames);
  double usual_m_ = 0.0;  ///< error without a mutation
};

/// Up to three mutations of different parts of the recording.
std::vector<const Mutation*> choose(const std::vector<Mutation>& all, Random* random) {
  std::vector<const Mutation*> chosen;
  int parts = 0;
  const std::size_t wanted = 1 + (*random)() % 3;
  for (int trial = 0; trial < 20 && chosen.size() < wanted; ++trial) {
    const Mutation& mutation = all[(*random)() % all.size()];
    // One that spoils the recording is enough, otherwise most recordings would be spoilt.
    const bool spoilt = !mutation.works && (*random)() % 2 == 0;
    if ((mutation.parts & parts) != 0 || spoilt) continue;
    parts |= mutation.parts;
    chosen.push_back(&mutation);
  }
  return chosen;
}

/// RECORDINGS=N sets their number: first each mutation alone (make recordings).
TEST_F(MutatedRecordings, AreUsableExactlyWhenTheyCanBeTrackedAndMeasured) {
  const char* const wanted = std::getenv("RECORDINGS");
  const int count = wanted != nullptr ? std::atoi(wanted) : kQuick;
  const std::vector<Mutation> all = allMutations();
  Random random(35);
  for (int k = 0; k < count; ++k) {
    const bool alone = wanted != nullptr && k < static_cast<int>(all.size());
    expectAgreement(
        alone ? std::vector<const Mutation*>{&all[static_cast<std::size_t>(k)]} : choose(all, &random),
        &random);
  }
  std::cout << count << " recordings of " << all.size() << " mutations and their combinations\n";
}

}  // namespace
}  // namespace softbody::recordings
