#include "study/TrialSound.h"

#include "study/Exposure.h"
#include "study/StudyCheck.h"
#include "study/StudyFile.h"
#include "study/StudyTemplates.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Paths.h"
#include "support/ShippedProfile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

using namespace pacini;
using namespace pacini::study;

namespace
{
/// Magnitude of the weighting Wh at a frequency in Hz (ISO 5349-1:2001, annex A), in continuous time.
double handArmWeight(double frequency)
{
    constexpr double turn = 2.0 * std::numbers::pi;
    constexpr double w1 = turn * 6.310, w2 = turn * 1258.9, w3 = turn * 15.915, w4 = turn * 15.915, q1 = 0.71,
                     q2 = 0.64;
    const std::complex<double> s(0.0, turn * frequency);
    const auto high = s * s / (s * s + s * w1 / q1 + w1 * w1);
    const auto low = w2 * w2 / (s * s + s * w2 / q1 + w2 * w2);
    const auto transition = (s + w3) * w4 * w4 / ((s * s + s * w4 / q2 + w4 * w4) * w3);
    return std::abs(high * low * transition);
}

Study withClicks()
{
    Study study;
    study.name = "clicks";
    study.groups = {{"all", 2}};
    Stimulus demo;
    demo.name = "demo";
    demo.sound = "Resources/demo/knock_wood_bridge.flac";
    Stimulus tone;
    tone.name = "tone";
    tone.tone = Tone{160.0, 0.5, 0.05, -6.0};
    Stimulus nothing;
    nothing.name = "nothing";
    nothing.silence = 0.5;
    study.stimuli = {demo, tone, nothing};
    Block block;
    block.name = "block";
    block.question = {{"en", "?"}};
    study.blocks = {block};
    return study;
}

StimulusParams here()
{
    StimulusParams params;
    params.folder = sourceFolder();
    return params;
}

} // namespace

TEST_CASE("Touch follows sound by the delay of the block, to the sample")
{
    Study study = withClicks();
    for (const double delay : {-0.2, 0.0, 0.001, 0.25})
    {
        study.blocks[0].delay = delay;
        StimulusMaker maker(study, here());
        const auto plain = maker.make(0);
        REQUIRE(plain);
        const auto made = makeTrial(maker, {0, {0}}, {}, 1);
        REQUIRE(made);
        CHECK(made->sound.size() == made->touch.size());
        const auto first = [](const std::vector<float>& samples)
        {
            return static_cast<long>(std::find_if(samples.begin(), samples.end(), [](float x) { return x != 0.0f; }) -
                                     samples.begin());
        };
        const long wanted = first(plain->touch) - first(plain->sound) + std::lround(delay * 48000.0);
        CHECK(static_cast<long>(*made->touchOnset) - static_cast<long>(*made->soundOnset) == wanted);
    }
}

TEST_CASE("One after the other means: first the sound alone, then the touch alone")
{
    Study study = withClicks();
    study.blocks[0].presentation = Presentation::consecutive;
    study.blocks[0].pause = 0.5;
    StimulusMaker maker(study, here());
    const auto plain = maker.make(0);
    const auto made = makeTrial(maker, {0, {0}}, {}, 1);
    REQUIRE(plain);
    REQUIRE(made);
    const std::size_t length = plain->sound.size();
    CHECK(made->sound.size() == 2 * length + 24000);
    CHECK(std::equal(plain->sound.begin(), plain->sound.end(), made->sound.begin()));
    CHECK(
        std::equal(plain->touch.begin(), plain->touch.end(), made->touch.end() - static_cast<std::ptrdiff_t>(length)));
    CHECK(std::all_of(made->touch.begin(), made->touch.begin() + static_cast<std::ptrdiff_t>(length + 24000),
                      [](float x) { return x == 0.0f; }));
    // Noise only where something is felt.
    study.blocks[0].masking = true;
    StimulusMaker masked(study, here());
    const auto noisy = makeTrial(masked, {0, {0}}, {}, 1);
    REQUIRE(noisy);
    CHECK(std::equal(made->sound.begin(), made->sound.begin() + static_cast<std::ptrdiff_t>(length + 24000),
                     noisy->sound.begin()));
    double power = 0.0;
    for (std::size_t n = length + 24000; n < noisy->sound.size(); ++n)
        power += static_cast<double>(noisy->sound[n]) * static_cast<double>(noisy->sound[n]);
    CHECK(10.0 * std::log10(power / static_cast<double>(length)) == Approx(study.masking.level).margin(1.0));
}

TEST_CASE("In a detection task only one interval can be felt, at the level that is asked for")
{
    const auto study = makeStudy("threshold", {});
    REQUIRE(study);
    StimulusMaker maker(*study, here());
    for (Trial trial : trialsOf(*study, 0, 0))
    {
        if (trial.stimuli[0] > 1)
            continue;
        const auto made = makeTrial(maker, trial, -26.0, 1);
        REQUIRE(made);
        REQUIRE(made->parts.size() == 3);
        for (std::size_t i = 0; i < 3; ++i)
        {
            const auto begin = made->touch.begin();
            const std::vector<float> part(begin + static_cast<std::ptrdiff_t>(made->parts[i].begin),
                                          begin + static_cast<std::ptrdiff_t>(made->parts[i].end));
            if (static_cast<int>(i) == trial.right)
                CHECK(20.0 * std::log10(test::peakOf(part)) == Approx(-26.0).margin(0.1));
            else
                CHECK(test::peakOf(part) == 0.0);
        }
    }
}

TEST_CASE("Whatever a study asks for, the actuator gets no more than it bears")
{
    const Profile profile = test::shippedProfile("l5-wristband");
    Study study = withClicks();
    study.touchLevel = 40.0;
    for (Stimulus& stimulus : study.stimuli)
        stimulus.touchLevel = 40.0;
    StimulusParams params = here();
    StimulusMaker unknown(study, params);
    params.profile = profile;
    StimulusMaker known(study, params);
    for (std::size_t i = 0; i < study.stimuli.size(); ++i)
        for (StimulusMaker* maker : {&unknown, &known})
        {
            const auto made = maker->make(i);
            REQUIRE(made);
            CHECK(test::peakOf(made->touch) <= 1.0);
        }
    // Louder by 40 dB is what it was where it fits: protection, not distortion of everything.
    CHECK(test::peakOf(known.make(2)->touch) == 0.0);
}

TEST_CASE("A file that is missing is said with the stimulus it belongs to")
{
    Study study = withClicks();
    study.stimuli[0].sound = "gone.wav";
    StimulusMaker maker(study, here());
    const auto made = maker.make(0);
    REQUIRE_FALSE(made);
    CHECK(made.error().where == "stimuli[0] (\"demo\")");
    CHECK(made.error().message.find("gone.wav") != std::string::npos);
}

TEST_CASE("The weighting that doses are compared with is that of the table of ISO 5349-1")
{
    // Table A.2, at the exact frequencies of third octaves.
    const std::vector<std::pair<int, double>> table{
        {8, 0.727},   {9, 0.873},   {10, 0.951},  {11, 0.958},  {12, 0.896},  {13, 0.782},
        {14, 0.647},  {15, 0.519},  {16, 0.411},  {17, 0.324},  {18, 0.256},  {19, 0.202},
        {20, 0.160},  {21, 0.127},  {22, 0.101},  {23, 0.0799}, {24, 0.0634}, {25, 0.0503},
        {26, 0.0398}, {27, 0.0314}, {28, 0.0245}, {29, 0.0186}, {30, 0.0135}, {31, 0.00894}};
    for (const auto& [band, weight] : table)
        CHECK(handArmWeight(std::pow(10.0, band / 10.0)) == Approx(weight).epsilon(0.01));
}

TEST_CASE("The dose of a sine is that of its weighted RMS")
{
    for (const double frequency : {16.0, 100.0, 250.0})
    {
        std::vector<float> samples(20 * 48000);
        for (std::size_t n = 0; n < samples.size(); ++n)
            samples[n] = static_cast<float>(
                10.0 * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(n) / 48000.0));
        const double rms = handArmWeight(frequency) * 10.0 / std::sqrt(2.0);
        CHECK(doseOf(samples, 48000.0, ExposedPart::hand) == Approx(20.0 * rms * rms).epsilon(0.02));
    }
    // Eight hours at 1 m/s2.
    CHECK(dailyExposure(8.0 * 3600.0) == Approx(1.0));
}

TEST_CASE("The dose of a seat follows the vertical weighting of ISO 2631-1")
{
    // Its table 3, Wk at third octaves.
    const std::vector<std::pair<double, double>> table{{1.0, 0.482}, {2.0, 0.531},  {4.0, 0.967},  {5.0, 1.039},
                                                       {8.0, 1.036}, {16.0, 0.768}, {31.5, 0.405}, {80.0, 0.132}};
    for (const double sampleRate : {8000.0, 48000.0, 384000.0})
        for (const auto& [frequency, weight] : table)
        {
            // Twenty seconds and the half of them: what rings in at first falls out.
            const auto of = [&, hz = frequency](double seconds)
            {
                std::vector<float> samples(static_cast<std::size_t>(seconds * sampleRate));
                for (std::size_t n = 0; n < samples.size(); ++n)
                    samples[n] =
                        static_cast<float>(std::sin(2.0 * std::numbers::pi * hz * static_cast<double>(n) / sampleRate));
                return doseOf(samples, sampleRate, ExposedPart::wholeBody);
            };
            CAPTURE(sampleRate, frequency);
            CHECK(std::sqrt((of(12.0) - of(4.0)) / 8.0 * 2.0) == Approx(weight).epsilon(0.01));
        }
}

TEST_CASE("A study of seats has the limits of the whole body", "[study]")
{
    Study study = withClicks();
    study.limits.part = ExposedPart::wholeBody;
    study.limits.daily = actionValue(ExposedPart::wholeBody);
    const auto text = studyJson(study);
    const auto read = readStudyJson(text);
    REQUIRE(read);
    CHECK(*read == study);
    const auto with = [&](const std::string& limits)
    {
        auto changed = nlohmann::json::parse(text);
        changed["limits"] = nlohmann::json::parse(limits);
        return readStudyJson(changed.dump());
    };
    CHECK(with(R"({"part": "wholeBody"})")->limits.daily == 0.5);
    CHECK(with(R"({"part": "hand"})")->limits.daily == 2.5);
    CHECK(with(R"({"daily": 5})")->limits.part == ExposedPart::hand);
    CHECK(with(R"({"part": "wholeBody", "daily": 1.2})").error().where == "limits.daily");
    CHECK(with(R"({"part": "foot"})").error().where == "limits.part");
}

TEST_CASE("What would spoil a study is found before anybody comes")
{
    const auto silent = [](double) {
    };
    Study study = withClicks();
    study.welcome = {{"en", "Hello"}, {"de", "Hallo"}};
    study.stimuli[2] = study.stimuli[1];
    study.stimuli[2].name = "the same tone";
    study.groups.push_back({"few", 1});
    study.limits.minutes = 1.0;
    study.blocks[0].repeats = 100;
    study.blocks[0].presentation = Presentation::touch;
    const StudyCheck found = checkStudy(study, here(), silent);
    const auto says = [&](const std::string& text, bool spoils)
    {
        return std::any_of(found.findings.begin(), found.findings.end(),
                           [&](const Finding& one)
                           { return one.spoils == spoils && one.message.find(text) != std::string::npos; });
    };
    CHECK(says("can hardly be told apart", false));
    CHECK(says("uneven", false));
    CHECK(says("single participant", false));
    CHECK(says("no text in \"de\"", false));
    CHECK(says("hear the actuator", false));
    CHECK(says("minutes", true));

    Study strong = withClicks();
    strong.stimuli.resize(2);
    strong.stimuli[1].tone = Tone{16.0, 60.0, 0.05, 0.0};
    strong.blocks[0].repeats = 30;
    strong.blocks[0].masking = true;
    const StudyCheck exposed = checkStudy(strong, here(), silent);
    CHECK(exposed.exposureIsAssumed);
    CHECK(std::any_of(exposed.findings.begin(), exposed.findings.end(),
                      [](const Finding& one) { return one.spoils && one.where == "limits.daily"; }));
}

TEST_CASE("A touch is as strong as its sensation level or acceleration says", "[study][stimuli]")
{
    Study study = withClicks();
    StimulusParams params;
    params.folder = sourceFolder();
    const auto peak = [](const std::vector<float>& samples)
    {
        double largest = 0.0;
        for (const float sample : samples)
            largest = std::max(largest, std::abs(static_cast<double>(sample)));
        return largest;
    };
    const auto touchOf = [&](std::size_t stimulus)
    {
        StimulusMaker maker(study, params);
        return maker.make(stimulus);
    };
    for (const char* name : {"l5-wristband", "lra-175", "erm-coin", "dualsense-voice-coil"})
    {
        CAPTURE(name);
        params.profile = test::shippedProfile(name);
        for (const std::size_t stimulus : {0u, 1u})
        {
            CAPTURE(stimulus);
            study.stimuli[stimulus].sensationLevel = 0.5 * params.profile->range.dynamicRange;
            study.stimuli[stimulus].acceleration = std::nullopt;
            const auto felt = touchOf(stimulus);
            REQUIRE(felt);
            CHECK_THAT(20.0 * std::log10(params.profile->drive.overdrive * peak(felt->touch)),
                       Catch::Matchers::WithinAbs(-0.5 * params.profile->range.dynamicRange, 0.5));
            study.stimuli[stimulus].touchLevel = -6.0;
            const auto weaker = touchOf(stimulus);
            REQUIRE(weaker);
            CHECK_THAT(20.0 * std::log10(peak(weaker->touch) / peak(felt->touch)),
                       Catch::Matchers::WithinAbs(-6.0, 0.5));
            study.stimuli[stimulus].touchLevel = 0.0;
            study.stimuli[stimulus].sensationLevel = std::nullopt;
            // A motor has one speed for each drive, and none for what alternates.
            if (!params.profile->body || params.profile->technology == Technology::erm)
                continue;
            study.stimuli[stimulus].acceleration = 2.0;
            const auto accelerated = touchOf(stimulus);
            REQUIRE(accelerated);
            CHECK_THAT(peak(feltOf(accelerated->touch, params.profile, params.sampleRate)),
                       Catch::Matchers::WithinRel(2.0, 0.05));
            // What the actuator cannot do is said, not left out.
            study.stimuli[stimulus].acceleration = 900.0;
            const auto tooMuch = touchOf(stimulus);
            REQUIRE_FALSE(tooMuch);
            CHECK(tooMuch.error().message.find("within its limits") != std::string::npos);
            study.stimuli[stimulus].acceleration = std::nullopt;
        }
    }
    params.profile = std::nullopt;
    study.stimuli[1].sensationLevel = 20.0;
    CHECK_FALSE(touchOf(1));
    // A staircase of levels looks for the threshold itself.
    StimulusMaker maker(study, params);
    CHECK(maker.make(1, Variation{Variable::level, -20.0}));
}

TEST_CASE("The bits of a stimulus change what is felt, by each method that makes a clip", "[study][stimuli]")
{
    for (const char* method : {"", "envelope-sine", "thesis"})
    {
        Study study = withClicks();
        study.stimuli[0].method = method;
        study.stimuli[0].bits = 4.0;
        Stimulus fine = study.stimuli[0];
        fine.bits = 16.0;
        study.stimuli.push_back(fine);
        StimulusMaker maker(study, here());
        const auto coarse = maker.make(0), finest = maker.make(3);
        REQUIRE(coarse);
        REQUIRE(finest);
        CHECK(coarse->touch != finest->touch);
    }
}
