// Files on their way into the project, and sounds that go missing.

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/clip/session/ClipSteps.h"
#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "support/TempFolder.h"

#include <pacini/foundation/Random.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// Hits with decaying tones and noise, two channels.
std::filesystem::path writeSound(const std::filesystem::path& path, double seconds, std::uint64_t seed = 1)
{
    constexpr int rate = 48000;
    std::vector<float> samples(2 * static_cast<std::size_t>(seconds * rate));
    Random random(seed);
    double phase = 0.0, level = 0.0, frequency = 100.0;
    for (std::size_t i = 0; i < samples.size() / 2; ++i)
    {
        if (i % 12000 == 0)
        {
            level = random.uniform(0.2, 0.8);
            frequency = random.uniform(60.0, 600.0);
        }
        phase += 2.0 * std::numbers::pi * frequency / rate;
        level *= 0.9997;
        for (std::size_t c = 0; c < 2; ++c)
            samples[2 * i + c] =
                static_cast<float>(level * std::sin(phase + static_cast<double>(c)) + 0.02 * random.uniform(-1.0, 1.0));
    }
    REQUIRE(writeAudio(path, samples,
                       {.sampleRate = rate, .channels = 2, .encoding = SampleEncoding::pcm16, .ditherSeed = 1}));
    return path;
}

struct Messages
{
    std::vector<std::string> titles, texts;

    explicit Messages(editor::Session& session)
    {
        session.model.onError = [this](const juce::String& title, const juce::String& text)
        {
            titles.push_back(title.toStdString());
            texts.push_back(text.toStdString());
        };
    }
};

bool idle(const editor::Session& session)
{
    return !session.sounds.workNow();
}

std::size_t clipCount(const editor::Session& session)
{
    return session.model.document().project().clips.size();
}
} // namespace

TEST_CASE("A sound is shown as a waveform before it is analysed, and then becomes a clip in the same view")
{
    TempFolder folder;
    EditorBench bench;
    editor::Session& session = bench.session;
    session.sounds.openFiles({writeSound(folder / "long.wav", 20.0)});
    REQUIRE(pumpUntil([&] { return session.model.isShowingUnanalysed(); }));
    // Waveform and time are there; edits are not possible yet.
    CHECK(session.model.clip() == nullptr);
    REQUIRE(session.sounds.soundOfClip() != nullptr);
    CHECK(session.model.duration() == Approx(20.0));
    CHECK(session.viewState.axis().secondsPerPixel * session.viewState.viewWidth() == Approx(20.0 * 1.02));
    CHECK(bench.view.clipView().isVisible());
    REQUIRE(session.sounds.workNow());
    CHECK(session.sounds.workNow()->text.contains("long.wav"));
    CHECK_FALSE(session.model.document().steps().canUndo());
    session.viewState.zoom(0.5, 100.0);
    const TimeAxis axis = session.viewState.axis();
    REQUIRE(pumpUntil([&] { return session.model.clip() != nullptr; }));
    CHECK(session.model.clip()->duration == Approx(20.0));
    CHECK(session.viewState.axis() == axis);
    CHECK_FALSE(session.model.isShowingUnanalysed());
    CHECK(idle(session));
    CHECK_FALSE(session.model.document().steps().canUndo());
    CHECK(*session.model.clip() == editor::importFile(folder / "long.wav", {})->clip);
}

TEST_CASE("Stopping leaves the project as it was, whatever is under way")
{
    TempFolder folder;
    const auto file = writeSound(folder / "long.wav", 20.0);
    for (const bool analysing : {false, true})
    {
        EditorBench bench;
        editor::Session& session = bench.session;
        const Messages messages(session);
        bench.openDemo("knock_wood_bridge");
        const int before = session.model.activeId();
        session.sounds.openFiles({file, file});
        if (analysing)
            REQUIRE(pumpUntil([&] { return session.model.isShowingUnanalysed(); }));
        CHECK(bench.view.doCommand(editor::stopWork));
        CHECK(idle(session));
        CHECK_FALSE(session.model.isShowingUnanalysed());
        CHECK(session.model.activeId() == before);
        pumpFor(0.5);
        CHECK(clipCount(session) == 1);
        CHECK(messages.titles.empty());
        CHECK_FALSE(bench.view.doCommand(editor::stopWork));
    }
}

TEST_CASE("Several files come in their order, the first is shown, and what fails is told once at the end")
{
    TempFolder folder;
    std::filesystem::create_directories(folder / "in/deeper");
    writeSound(folder / "in/b.wav", 1.0, 2);
    writeSound(folder / "in/a.wav", 1.0, 3);
    writeSound(folder / "in/deeper/c.wav", 1.0, 4);
    put(folder / "in/broken.wav", "RIFF but no more");
    put(folder / "in/empty.flac", "");
    put(folder / "in/read me.txt", "no sound");
    EditorBench bench;
    editor::Session& session = bench.session;
    const Messages messages(session);
    session.sounds.openFiles({folder / "in"});
    REQUIRE(pumpUntil([&] { return idle(session); }));
    std::vector<std::string> names;
    for (const auto& item : session.model.document().project().clips)
        names.push_back(item->clip->name);
    CHECK(names == std::vector<std::string>{"a", "b", "c"});
    CHECK(session.model.item()->clip->name == "a");
    REQUIRE(messages.titles.size() == 1);
    CHECK(messages.titles[0] == "2 of 5 files not opened");
    CHECK(messages.texts[0].find("broken.wav") != std::string::npos);
    CHECK(messages.texts[0].find("empty.flac") != std::string::npos);
}

TEST_CASE("Who turns to another clip while a sound is analysed is left there")
{
    TempFolder folder;
    EditorBench bench;
    editor::Session& session = bench.session;
    bench.openDemo("knock_wood_bridge");
    const int before = session.model.activeId();
    session.sounds.openFiles({writeSound(folder / "long.wav", 20.0)});
    REQUIRE(pumpUntil([&] { return session.model.isShowingUnanalysed(); }));
    session.model.show(before);
    REQUIRE(pumpUntil([&] { return idle(session); }));
    CHECK(clipCount(session) == 2);
    CHECK(session.model.activeId() == before);
}

TEST_CASE("A project without its sound says so once, can be edited, and finds the sound where it is shown")
{
    TempFolder folder;
    std::filesystem::create_directories(folder / "elsewhere");
    writeSound(folder / "hit.wav", 1.0);
    {
        EditorBench bench;
        bench.session.sounds.add(editor::importFile(folder / "hit.wav", {}).value());
        REQUIRE(bench.session.model.saveAs(folder / "p.pacini"));
    }
    std::filesystem::rename(folder / "hit.wav", folder / "elsewhere/renamed.wav");
    EditorBench bench;
    editor::Session& session = bench.session;
    const Messages messages(session);
    int told = 0;
    session.sounds.onSoundsMissing = [&](const std::vector<AudioReference>& missing)
    {
        ++told;
        REQUIRE(missing.size() == 1);
        CHECK(missing[0].path == folder / "hit.wav");
    };
    session.sounds.openFiles({folder / "p.pacini"});
    REQUIRE(pumpUntil([&] { return told > 0; }));
    pumpFor(0.1);
    CHECK(told == 1);
    CHECK(messages.titles.empty());
    const int source = session.model.item()->source;
    CHECK(session.sounds.isMissing(source));
    CHECK(editor::editClip(session.model, "Reverse", ReverseEdit{}));
    session.model.undo();

    writeSound(folder / "other.wav", 1.0, 99);
    session.sounds.findSounds(folder / "other.wav");
    REQUIRE(pumpUntil([&] { return !messages.titles.empty(); }));
    CHECK(messages.titles[0] == "other.wav is a different sound");
    CHECK(session.sounds.isMissing(source));

    session.sounds.findSounds(folder / "elsewhere/renamed.wav");
    REQUIRE(pumpUntil([&] { return session.sounds.soundOfClip() != nullptr; }));
    CHECK_FALSE(session.sounds.isMissing(source));
    CHECK(session.model.document().steps().undoName() == "Find sound");
    CHECK(session.model.document().project().sources[0].path == folder / "elsewhere/renamed.wav");
}

TEST_CASE("A copy inside the project makes it independent of the file, and the only copy is never given up")
{
    TempFolder folder;
    writeSound(folder / "hit.wav", 1.0);
    {
        EditorBench bench;
        bench.session.sounds.add(editor::importFile(folder / "hit.wav", {}).value());
        bench.session.sounds.keepSound(bench.session.model.item()->source, true);
        REQUIRE(pumpUntil([&] { return bench.session.model.document().project().sources[0].embedded != nullptr; }));
        CHECK(bench.session.model.document().steps().undoName() == "Embed sound");
        REQUIRE(bench.session.model.saveAs(folder / "p.pacini"));
    }
    const std::string bytes = bytesOf(folder / "hit.wav");
    std::filesystem::remove(folder / "hit.wav");
    EditorBench bench;
    editor::Session& session = bench.session;
    const Messages messages(session);
    REQUIRE(session.model.openProject(folder / "p.pacini"));
    REQUIRE(pumpUntil([&] { return session.sounds.soundOfClip() != nullptr; }));
    CHECK(*session.model.document().project().sources[0].embedded == bytes);
    session.sounds.keepSound(session.model.item()->source, false);
    REQUIRE(pumpUntil([&] { return !messages.titles.empty(); }));
    CHECK(messages.titles[0] == "Embedded sound kept");
    CHECK(session.model.document().project().sources[0].embedded != nullptr);
    CHECK_FALSE(session.model.document().isDirty());
}

#ifdef __linux__
TEST_CASE("A project that cannot be written says why, stays open with its changes, and lets nothing follow")
{
    TempFolder folder;
    EditorBench bench;
    editor::Session& session = bench.session;
    bench.openDemo("knock_wood_bridge");
    REQUIRE(session.model.saveAs(folder / "p.pacini"));
    REQUIRE(editor::editClip(session.model, "Reverse", ReverseEdit{}));
    const Clip edited = bench.clip();
    std::filesystem::remove(folder / "p.pacini");
    std::filesystem::create_symlink("/dev/full", folder / "p.pacini");
    bool followed = false;
    bench.view.files().save([&] { followed = true; });
    REQUIRE(bench.view.sheet() != nullptr);
    CHECK(bench.view.sheet()->getTitle() == "Not saved");
    CHECK(bench.view.sheet()->getDescription().contains("p.pacini"));
    CHECK(bench.view.sheet()->getDescription().contains("the disk is full"));
    CHECK_FALSE(followed);
    CHECK(session.model.document().isDirty());
    CHECK(bench.clip() == edited);
    std::filesystem::remove(folder / "p.pacini");
    bench.view.files().save([&] { followed = true; });
    CHECK(followed);
    CHECK_FALSE(session.model.document().isDirty());
}
#endif

TEST_CASE("No message is lost behind another")
{
    EditorBench bench;
    bench.session.model.onError("First", "one");
    bench.session.model.onError("Second", "two");
    REQUIRE(bench.view.sheet() != nullptr);
    CHECK(bench.view.sheet()->getTitle() == "First");
    bench.view.showSheet(nullptr);
    REQUIRE(bench.view.sheet() != nullptr);
    CHECK(bench.view.sheet()->getTitle() == "Second");
    bench.view.showSheet(nullptr);
    CHECK(bench.view.sheet() == nullptr);
}

TEST_CASE("Opening a minute of stereo, in figures", "[.bench]")
{
    using Clock = std::chrono::steady_clock;
    TempFolder folder;
    for (const char* name : {"minute.wav", "minute.flac"})
        writeSound(folder / name, 60.0);
    for (const char* name : {"minute.wav", "minute.flac"})
    {
        std::map<std::string, double> best = {{"waveform", 1e9}, {"analysis", 1e9}, {"drawn", 1e9}};
        for (int run = 0; run < 5; ++run)
        {
            EditorBench bench;
            editor::Session& session = bench.session;
            const auto start = Clock::now();
            const auto since = [&]
            {
                return std::chrono::duration<double>(Clock::now() - start).count();
            };
            const auto draw = [&]
            {
                (void)bench.view.createComponentSnapshot(bench.view.getLocalBounds());
            };
            session.sounds.openFiles({folder / name});
            REQUIRE(pumpUntil([&] { return session.model.isShowingUnanalysed(); }));
            draw();
            best["waveform"] = std::min(best["waveform"], since());
            REQUIRE(pumpUntil([&] { return session.model.clip() != nullptr; }));
            best["analysis"] = std::min(best["analysis"], since());
            draw();
            best["drawn"] = std::min(best["drawn"], since());
        }
        std::printf("%s: waveform drawn after %.3f s, analysis after %.3f s, all drawn after %.3f s\n", name,
                    best["waveform"], best["analysis"], best["drawn"]);
    }
}

TEST_CASE("What is opened while the sample project is there begins a project of its own")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    editor::Session session{{}, {}};
    editor::HostServices around;
    around.demoSounds = {demoSound("knock_wood_bridge")};
    editor::EditorView view{session, around};
    view.setBounds(0, 0, 1280, 800);
    const TempFolder folder;
    const auto sound = writeSound(folder / "mine.wav", 1.0);
    const auto openSample = [&]
    {
        session.model.newProject();
        REQUIRE(view.doCommand(editor::openSample));
        REQUIRE(clipCount(session) >= 3);
        REQUIRE(session.model.isSample());
    };
    const auto namesNow = [&]
    {
        std::vector<std::string> names;
        for (const auto& item : session.model.document().project().clips)
            names.push_back(item->clip->name);
        return names;
    };
    openSample();
    view.files().open({sound});
    REQUIRE(pumpUntil([&] { return idle(session) && session.model.clip() != nullptr; }));
    CHECK(namesNow() == std::vector<std::string>{"mine"});
    CHECK_FALSE(session.model.isSample());
    // The next one joins it: now it is the user's.
    view.files().open({demoSound("impact_boom")});
    REQUIRE(pumpUntil([&] { return idle(session) && clipCount(session) == 2; }));

    // By the demo menu and by dropping, too.
    openSample();
    juce::StringArray dropped{juce::String(sound.string())};
    static_cast<juce::FileDragAndDropTarget&>(view).filesDropped(dropped, 0, 0);
    REQUIRE(pumpUntil([&] { return idle(session) && namesNow() == std::vector<std::string>{"mine"}; }));

    // Work on the sample is not lost without a word.
    openSample();
    view.doCommand(editor::fadeOut);
    view.files().open({sound});
    REQUIRE(view.sheet() != nullptr);
    CHECK(view.sheet()->getTitle() == "Save the changes?");
    CHECK(clipCount(session) >= 3);
    answer(*view.sheet(), "Don't save");
    REQUIRE(pumpUntil([&] { return idle(session) && namesNow() == std::vector<std::string>{"mine"}; }));

    // Who saves it has made it an own project.
    openSample();
    REQUIRE(session.model.saveAs(folder / "own.pacini"));
    const std::size_t before = clipCount(session);
    view.files().open({sound});
    REQUIRE(pumpUntil([&] { return idle(session) && clipCount(session) == before + 1; }));
    CHECK(session.model.document().path() == folder / "own.pacini");
}

TEST_CASE("A sound that was cut off is opened as far as it goes, and its loss is told")
{
    TempFolder folder;
    const auto wave = writeSound(folder / "broken.wav", 4.0);
    const auto flac = folder / "half.flac";
    std::filesystem::copy_file(demoSound("drums_tabla_pattern"), flac);
    for (const auto& file : {wave, flac})
    {
        CAPTURE(file);
        std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
        EditorBench bench;
        const Messages messages(bench.session);
        bench.session.sounds.openFiles({file});
        REQUIRE(pumpUntil([&] { return bench.session.model.clip() != nullptr && idle(bench.session); }));
        CHECK(bench.session.model.clip()->duration > 1.0);
        CHECK(bench.session.model.clip()->duration < 2.6);
        REQUIRE(messages.texts.size() == 1);
        CHECK(messages.titles[0] == "Imported with losses");
        CHECK(messages.texts[0].starts_with(file.stem().string() + ": "));
        CHECK(messages.texts[0].find(" s are there") != std::string::npos);
    }
}
