// The table of formats: which one a file is of, and which one is written to an extension.

#include "io/formats/ClipFormat.h"

#include "io/formats/FormatSamples.h"
#include "io/formats/json/ClipJson.h"
#include "io/formats/json/JsonFormat.h"
#include "support/Catch.h"
#include "support/ShippedProfile.h"

#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
std::string formatFound(std::string_view extension, std::string_view bytes)
{
    const ClipFormat* format = clipFormatOf(extension, bytes);
    return format == nullptr ? "none" : std::string(format->name);
}

std::string formatWritten(std::string_view extension)
{
    const ClipFormat* format = clipFormatWrittenTo(extension);
    return format == nullptr ? "none" : std::string(format->name);
}
} // namespace

TEST_CASE("A file is of the format that its content says, and else of that of its extension", "[formats]")
{
    const std::string own = R"({"format": "pacini.clip", "version": 1, "duration": 1, "bands": []})";
    CHECK(formatFound(".json", own) == "json");
    CHECK(formatFound(".haptic", own) == "json");
    CHECK(formatFound("", own) == "json");
    CHECK(formatFound(".hjif", test::hjifSample()) == "hjif");
    CHECK(formatFound(".json", test::hjifSample()) == "hjif");
    CHECK(formatFound(".ahap", test::hjifSample()) == "hjif");
    CHECK(formatFound(".json", test::androidWaveformSample()) == "android");
    CHECK(formatFound("", test::androidEnvelopeSample(true)) == "android");
    CHECK(formatFound("", test::androidEnvelopeSample(false)) == "android");
    CHECK(formatFound("", test::hapsSample()) == "haps");
    CHECK(formatFound("", test::tactSample()) == "tact");
    CHECK(formatFound("", test::csvSample()) == "csv");
    CHECK(formatFound("", "time;x") == "csv");
    CHECK(formatFound("", "time\tx") == "csv");
    CHECK(formatFound("", "time") == "none");
    CHECK(formatFound("", R"({"project")") == "none");
    CHECK(formatFound("", R"({"tracks")") == "none");
    CHECK(formatFound("", R"({"timings")") == "none");
    CHECK(formatFound("", R"({"amplitudes")") == "none");
    CHECK(formatFound("", R"({"signals" "envelopes")") == "haptic");
    CHECK(formatFound("", R"({"signals")") == "none");
    CHECK(formatFound("", R"({"voices" "envelopes")") == "vij");
    CHECK(formatFound("", R"({"voices")") == "none");
    CHECK(formatFound("", R"({"clips" "clipId")") == "hasp");
    CHECK(formatFound("", R"({"clips")") == "none");
    CHECK(formatFound("", R"({"Pattern")") == "none");
    for (const char* other : {"Event", "ParameterCurve", "Version"})
        CHECK(formatFound("", std::string(R"({"Pattern" ")") + other + "\"") == "ahap");
    CHECK(formatFound("", "<vibration-effect>") == "android-xml");
    CHECK(formatFound(".xml", "<vibration-effect><waveform-envelope-effect>") == "android-envelope");
    CHECK(formatFound(".xml", "<vibration-effect><basic-envelope-effect initialSharpness=") == "android-basic");
    CHECK(formatFound(".xml", "<basic-envelope-effect>") == "android-xml");
    CHECK(formatFound("", "#ifndef HAPTIC_X") == "c");
    CHECK(formatFound(".h", "/* XR_FB_haptic_pcm: ") == "openxr");
    CHECK(formatFound("", R"("pcmVibration")") == "openxr-json");
    CHECK(formatFound("", R"("amplitudeEnvelopeVibration")") == "openxr-json");
    // Of two that recognise it the one with the extension counts, else the first.
    const std::string both = R"({"signals" "envelopes" "Pattern" "Version")";
    CHECK(formatFound(".ahap", both) == "ahap");
    CHECK(formatFound(".haptic", both) == "haptic");
    CHECK(formatFound(".json", both) == "haptic");
    // What none recognises.
    CHECK(formatFound(".haptic", "x") == "haptic");
    CHECK(formatFound(".csv", "x") == "csv");
    CHECK(formatFound(".json", "x") == "none");
    CHECK(formatFound(".pacb", "x") == "none");
    CHECK(formatFound(".xml", "x") == "android-xml");
    CHECK(formatFound(".s8", "x") == "raw8");
    CHECK(formatFound(".s16", "x") == "raw16");
    CHECK(formatFound(".wav", "x") == "none");
    CHECK(formatFound(".h", "x") == "none");
    CHECK(formatFound(".other", "x") == "none");
}

namespace
{
/// Two bands that swap, wander beyond what actuators play and have more points than any format takes, and events that
/// the bands reach.
Clip restlessClip()
{
    Clip clip;
    clip.duration = 2.0;
    for (const double centre : {90.0, 210.0})
    {
        Band& band = clip.bands.emplace_back();
        band.lowFrequency = 0.4 * centre;
        band.centreFrequency = centre;
        band.highFrequency = 1.7 * centre;
        for (int i = 0; i <= 400; ++i)
        {
            const double time = 0.005 * i, phase = time * (centre < 100.0 ? 40.0 : 53.0);
            band.amplitude.push_back({time, 0.4 + 0.3 * std::sin(phase)});
            band.pitch.push_back({time, centre * (1.0 + 0.6 * std::sin(0.7 * phase))});
        }
    }
    for (int i = 0; i <= 400; ++i)
        clip.envelope.push_back({0.005 * i, 0.5 + 0.3 * std::sin(0.23 * i)});
    for (int i = 1; i < 8; ++i)
        clip.transients.push_back({0.25 * i, 0.2, 0.5});
    return clip;
}
} // namespace

TEST_CASE("A format's choices are those of the parameters that change its bytes", "[formats]")
{
    const Clip clip = restlessClip();
    REQUIRE(validate(clip));
    for (const ClipFormat& format : clipFormats())
    {
        if (!format.isWritten())
            continue;
        CAPTURE(format.name);
        const auto bytesWith = [&](auto set)
        {
            ExportParams params;
            set(params);
            const auto exported = format.write(clip, params);
            REQUIRE(exported);
            std::string bytes;
            for (const ExportedFile& file : exported->files)
                bytes += file.suffix + ":" + file.bytes;
            return bytes;
        };
        const auto changes = [&](auto set)
        {
            return bytesWith(set) != bytesWith([](ExportParams&) {});
        };
        const ExportChoices& choices = format.choices;
        CHECK(choices.amplitudePoints == changes([](ExportParams& params) { params.amplitudePoints = 7.0; }));
        CHECK(choices.frequencyPoints == changes([](ExportParams& params) { params.frequencyPoints = 3.0; }));
        CHECK(choices.split == changes([](ExportParams& params) { params.split = true; }));
        CHECK(choices.quick == changes([](ExportParams& params) { params.quick = true; }));
        CHECK(choices.envelope == changes(
                                      [](ExportParams& params) {
                                          params.envelope = EnvelopeLimits{16, 20, 1000};
                                      }));
        CHECK(choices.drive == changes([](ExportParams& params) { params.sampleRate = 5000; }));
        CHECK(choices.profile ==
              changes([](ExportParams& params) { params.profile = test::shippedProfile("lra-175"); }));
        const auto withStrength = [](double strength)
        {
            return [strength](ExportParams& params)
            {
                params.profile = test::shippedProfile("lra-175");
                params.strength = strength;
            };
        };
        CHECK(choices.drive == (bytesWith(withStrength(0.0)) != bytesWith(withStrength(1.0))));
        CHECK(format.events.has_value() ==
              (bytesWith([](ExportParams& params) { params.events = EventExport::merged; }) !=
               bytesWith([](ExportParams& params) { params.events = EventExport::transients; })));
    }
}

TEST_CASE("The first format that is written to an extension is that of its files", "[formats]")
{
    const std::vector<std::pair<const char*, const char*>> all{{".json", "json"},
                                                               {".pacb", "packed"},
                                                               {".haptic", "haptic"},
                                                               {".vij", "none"},
                                                               {".hasp", "none"},
                                                               {".ahap", "ahap"},
                                                               {".hjif", "hjif"},
                                                               {".haps", "haps"},
                                                               {".xml", "android-xml"},
                                                               {".kt", "android-kotlin"},
                                                               {".java", "android-java"},
                                                               {".h", "openxr"},
                                                               {".tact", "tact"},
                                                               {".csv", "csv"},
                                                               {".wav", "wav8"},
                                                               {".s8", "raw8"},
                                                               {".s16", "raw16"},
                                                               {".other", "none"},
                                                               {"", "none"}};
    for (const auto& [extension, name] : all)
    {
        CAPTURE(extension);
        CHECK(formatWritten(extension) == name);
        CHECK(isOwnExtension(extension) ==
              (std::string_view(extension) == ".json" || std::string_view(extension) == ".pacb"));
    }
    CHECK(jsonFormat().name == "json");
    CHECK(packedFormat().name == "packed");
    CHECK(clipFormatNamed("none") == nullptr);
    std::set<std::string_view> names;
    for (const ClipFormat& format : clipFormats())
    {
        CHECK(names.insert(format.name).second);
        CHECK(clipFormatNamed(format.name) == &format);
        CHECK(format.isSamples == (format.keeps.starts_with("Drive signal samples for")));
        CHECK(format.companion == (format.name == "ahap" ? "-transients" : ""));
        CHECK((format.isRead() || format.isWritten()));
    }
    CHECK(names.size() == 25);
    const std::vector<std::pair<LossKind, std::string>> kinds{
        {LossKind::bands, "bands"},         {LossKind::points, "points"},     {LossKind::length, "length"},
        {LossKind::frequency, "frequency"}, {LossKind::timeStep, "timeStep"}, {LossKind::amplitude, "amplitude"},
        {LossKind::crowding, "crowding"},   {LossKind::event, "event"},       {LossKind::noise, "noise"},
        {LossKind::empty, "empty"},         {LossKind::text, "text"}};
    for (const auto& [kind, name] : kinds)
        CHECK(lossName(kind) == name);
    const ExportParams usual;
    CHECK_FALSE(usual.split);
    CHECK_FALSE(usual.quick);
    const FormatLoss loss;
    CHECK(loss == FormatLoss{LossKind::points, 0.0, 0.0, 0.0, ""});
}

TEST_CASE("Text is taken for JSON by its first brace, behind a mark or blanks", "[formats]")
{
    using namespace std::string_literals;
    for (const std::string& text : {"{"s, " \t\r\n{"s, "\xEF\xBB\xBF{"s, "\xFF\xFE{\0"s, "\xFE\xFF\0{"s})
        CHECK(looksLikeJson(text));
    for (const std::string& text : {""s, " "s, "["s, "x{"s, "\xFF\xFE{"s, "\xFF\xFE{a"s, "\xFE\xFF\0"s, "\xFE\xFF\0a"s})
        CHECK_FALSE(looksLikeJson(text));
    CHECK(isClipJson("{\"pacini.clip\""));
    CHECK_FALSE(isClipJson("{\"pacini\""));
    CHECK_FALSE(isClipJson("x\"pacini.clip\""));
    CHECK(isClipJson("{" + std::string(1023 - 11, ' ') + "pacini.clip"));
    CHECK_FALSE(isClipJson("{" + std::string(1024 - 11, ' ') + "pacini.clip"));
    CHECK(largestClipText == 536870912);
    CHECK(clipFormatVersion == 1);
}

TEST_CASE("A table tells bands of the same frequencies apart by a millionth", "[formats]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands.resize(3);
    for (Band& band : clip.bands)
    {
        band.lowFrequency = 50.0;
        band.centreFrequency = 60.0;
        band.highFrequency = 100.0;
        band.amplitude = {{0.0, 0.5}};
    }
    const auto exported = clipFormatNamed("csv")->write(clip);
    REQUIRE(exported.ok());
    const auto read = clipFormatNamed("csv")->read(exported->files.at(0).bytes);
    REQUIRE(read.ok());
    REQUIRE(read->clip.bands.size() == 3);
    CHECK(read->clip.bands[0].highFrequency == 100.0);
    CHECK(read->clip.bands[1].highFrequency == Approx(100.000101).epsilon(1e-12));
    CHECK(read->clip.bands[2].highFrequency == Approx(100.000202).epsilon(1e-12));
    REQUIRE(exported->losses.size() == 1);
    CHECK(exported->losses[0].kind == LossKind::frequency);
    CHECK(exported->losses[0].duration == 1.0);
    CHECK(exported->losses[0].error == Approx(2e-6 / 0.6931471805599453).epsilon(1e-4));
    for (Band& band : clip.bands)
        band.highFrequency = 400000.0;
    CHECK(clipFormatNamed("csv")->write(clip)->files.at(0).bytes.find(
              "amplitude 50 60 400000,amplitude 50 60 400000,") != std::string::npos);
    clip.bands.resize(2);
    clip.bands[1].lowFrequency = 51.0;
    CHECK(clipFormatNamed("csv")->write(clip)->losses.empty());
    clip.bands[1].lowFrequency = 50.0;
    clip.bands[1].centreFrequency = 61.0;
    CHECK(clipFormatNamed("csv")->write(clip)->losses.empty());
}

TEST_CASE("The table says how each format writes events unless something else is asked for, and which have a choice",
          "[formats]")
{
    Clip clip; // two bands, so that the voice is one of the format's own; the second event is no louder than they are
    clip.duration = 2.0;
    for (const double frequency : {80.0, 200.0})
        clip.bands.push_back(
            {frequency / 1.2, frequency, frequency * 1.2, 0, {{0.0, 0.4}, {1.0, 0.6}, {2.0, 0.2}}, {}});
    clip.envelope = {{0.0, 0.5}, {1.0, 0.8}, {2.0, 0.3}};
    clip.transients = {{0.5, 0.9, 0.5}, {1.0, 0.3, 0.8}};
    std::set<std::string_view> choices;
    for (const ClipFormat& format : clipFormats())
    {
        if (!format.isWritten())
            continue;
        CAPTURE(format.name);
        const auto bytesWith = [&](std::optional<EventExport> events)
        {
            ExportParams params;
            params.events = events;
            const auto written = format.write(clip, params);
            REQUIRE(written);
            std::string all;
            for (const ExportedFile& file : written->files)
                all += file.bytes + "\n";
            return all;
        };
        const std::string transients = bytesWith(EventExport::transients), merged = bytesWith(EventExport::merged);
        CHECK((transients != merged) == format.events.has_value());
        CHECK(bytesWith({}) == (format.events == EventExport::merged ? merged : transients));
        if (format.events)
            choices.insert(format.name);
    }
    CHECK(choices ==
          std::set<std::string_view>{"ahap", "haptic", "hjif", "hmpg", "pulsar"}); // as the help of --events says
}
