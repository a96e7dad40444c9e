#include "support/Catch.h"

#include <pacini.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace
{
/// A clip as people write it.
const std::string hum = R"({"format": "pacini.clip", "version": 1, "name": "hum", "duration": 1,
 "bands": [{"lowFrequency": 90, "centreFrequency": 100, "highFrequency": 110, "amplitude": [{"time": 0, "amplitude": 0.5}, {"time": 1, "amplitude": 0.5}]}],
 "transients": [{"time": 0.25, "amplitude": 0.9, "sharpness": 0.5}]})";
const std::string faintHum = R"({"format": "pacini.clip", "version": 1, "name": "faint", "duration": 1,
 "bands": [{"lowFrequency": 90, "centreFrequency": 100, "highFrequency": 110, "amplitude": [{"time": 0, "amplitude": 0.1}, {"time": 1, "amplitude": 0.1}]}]})";

std::string lastError()
{
    std::string text(pacini_last_error(nullptr, 0), '\0');
    pacini_last_error(text.data(), text.size());
    text.pop_back();
    return text;
}

void require(pacini_result result)
{
    INFO(pacini_result_text(result) << ": " << lastError());
    REQUIRE(result == PACINI_OK);
}

pacini_clip loaded(const std::string& text)
{
    pacini_clip clip = PACINI_NONE;
    require(pacini_clip_load(text.data(), text.size(), &clip));
    return clip;
}

pacini_engine created(std::uint32_t actuators = 1)
{
    pacini_engine_config config;
    pacini_engine_config_init(&config);
    config.actuator_count = actuators;
    config.sample_rate = 8000.0;
    pacini_engine engine = PACINI_NONE;
    require(pacini_engine_create(&config, &engine));
    return engine;
}

std::vector<float> rendered(pacini_engine engine, std::uint32_t frames)
{
    std::vector<float> out(frames);
    float* channels[] = {out.data()};
    require(pacini_render(engine, channels, 1, frames));
    return out;
}

float largest(const std::vector<float>& x)
{
    float most = 0.0f;
    for (const float v : x)
        most = std::max(most, std::abs(v));
    return most;
}

pacini_play_info infoOf(pacini_play play)
{
    pacini_play_info info;
    pacini_play_info_init(&info);
    require(pacini_play_get_info(play, &info));
    return info;
}
} // namespace

TEST_CASE("A texture is loaded, started, moved while it plays and stopped through C")
{
    const std::string wood = R"({"format": "pacini.texture", "version": 1, "pitch": 1, "levelBySpeed": 1,
 "levelByForce": 0.5, "nodes": [{"speed": 0.5, "level": 0.1, "reflection": [-0.6, 0.8]}],
 "tones": [{"frequency": 300, "levels": [0.05]}]})";
    pacini_texture texture = PACINI_NONE;
    require(pacini_texture_load(wood.data(), wood.size(), &texture));
    const pacini_engine engine = created();
    pacini_play play = PACINI_NONE;
    require(pacini_texture_start(engine, texture, 0.0, 1.0, nullptr, &play));
    CHECK(largest(rendered(engine, 1000)) == 0.0f);
    CHECK(infoOf(play).state == PACINI_PLAYING);
    require(pacini_play_set(play, PACINI_TEXTURE_SPEED, 0.5, 0.0, 0));
    rendered(engine, 100);
    const float loud = largest(rendered(engine, 4000));
    CHECK(loud > 0.2f);
    require(pacini_play_set(play, PACINI_TEXTURE_FORCE, 0.01, 0.01, 0));
    rendered(engine, 200);
    CHECK(largest(rendered(engine, 4000)) < 0.2f * loud);
    require(pacini_group_set(engine, 0, PACINI_NOISE, 0.0, 0.0, 0));
    rendered(engine, 200);
    CHECK(largest(rendered(engine, 1000)) == Approx(0.005 * std::sqrt(2.0)).epsilon(0.05));
    CHECK(pacini_play_seek(play, 0.5, 0) == PACINI_INVALID);
    CHECK(lastError() == "position: is none: a texture has no length");
    CHECK(pacini_play_set(play, PACINI_TEXTURE_SPEED, 1.5, 0.0, 0) == PACINI_INVALID);
    CHECK(pacini_play_set(play, PACINI_TEXTURE_SPEED, std::numeric_limits<double>::quiet_NaN(), 0.0, 0) ==
          PACINI_INVALID);
    // A texture that is released plays on.
    require(pacini_texture_release(texture));
    CHECK(pacini_texture_release(texture) == PACINI_STALE);
    CHECK(pacini_texture_start(engine, texture, 0.5, 1.0, nullptr, nullptr) == PACINI_STALE);
    CHECK(largest(rendered(engine, 1000)) > 0.0f);
    require(pacini_play_stop(play, 0.0, 0));
    rendered(engine, 200);
    CHECK(infoOf(play).state == PACINI_ENDED);
    // What is no texture.
    texture = {7};
    CHECK(pacini_texture_load(hum.data(), hum.size(), &texture) == PACINI_BAD_DATA);
    CHECK(pacini_texture_load("", 0, &texture) == PACINI_INVALID);
    CHECK(pacini_texture_load(wood.data(), 40, &texture) == PACINI_BAD_DATA);
    CHECK(pacini_texture_load_file("none.texture.json", &texture) == PACINI_IO);
    CHECK(texture.id == 7);
    const pacini_clip clip = loaded(hum);
    CHECK(pacini_texture_start(engine, {clip.id}, 0.5, 1.0, nullptr, nullptr) == PACINI_STALE);
    require(pacini_texture_load(wood.data(), wood.size(), &texture));
    CHECK(pacini_texture_start(engine, texture, 2.0, 1.0, nullptr, nullptr) == PACINI_INVALID);
    CHECK(pacini_texture_start(engine, texture, 0.5, -1.0, nullptr, nullptr) == PACINI_INVALID);
    require(pacini_engine_destroy(engine));
}

TEST_CASE("A clip is loaded from memory in any format, played, changed and stopped through C")
{
    CHECK(pacini_api_version() == 1000 * PACINI_API_MAJOR + PACINI_API_MINOR);
    const pacini_clip clip = loaded(hum);
    pacini_clip_info info;
    pacini_clip_info_init(&info);
    require(pacini_clip_get_info(clip, &info));
    CHECK(std::string(info.name) == "hum");
    CHECK(info.duration == 1.0);
    CHECK(info.events == 1);
    CHECK(info.bytes > 20);
    CHECK(info.bytes < 1000);

    const pacini_engine engine = created();
    pacini_play_settings settings;
    pacini_play_settings_init(&settings);
    settings.loop = -1.0;
    settings.frame = 1000;
    pacini_play play = PACINI_NONE;
    require(pacini_play_start(engine, clip, &settings, &play));
    CHECK(infoOf(play).state == PACINI_WAITING);
    CHECK(largest(rendered(engine, 1000)) == 0.0f);
    CHECK(largest(rendered(engine, 1000)) > 0.4f);
    CHECK(infoOf(play).state == PACINI_PLAYING);
    CHECK(infoOf(play).position == Approx(0.125).margin(0.01));
    require(pacini_play_set(play, PACINI_GAIN, 0.1, 0.01, 0));
    rendered(engine, 200);
    CHECK(largest(rendered(engine, 500)) < 0.15f);
    // Hot reload.
    require(pacini_play_set(play, PACINI_GAIN, 1.0, 0.0, 0));
    require(pacini_clip_reload(clip, faintHum.data(), faintHum.size()));
    rendered(engine, 400);
    CHECK(largest(rendered(engine, 1000)) == Approx(0.1).margin(0.02));
    // Levels of roles, of the play and of its group.
    require(pacini_play_set(play, PACINI_TONES, 0.5, 0.0, 0));
    require(pacini_play_set(play, PACINI_EVENTS, 0.0, 0.0, 0));
    rendered(engine, 400);
    CHECK(largest(rendered(engine, 1000)) == Approx(0.05).margin(0.01));
    require(pacini_group_set(engine, 0, PACINI_TONES, 0.0, 0.01, 0));
    rendered(engine, 400);
    CHECK(largest(rendered(engine, 1000)) == 0.0f);
    CHECK(pacini_play_set(play, PACINI_NOISE, -1.0, 0.0, 0) == PACINI_INVALID);
    CHECK(lastError() == "noise: must be 0 to 1000");
    CHECK(pacini_play_set(play, PACINI_TEXTURE_FORCE + 1, 1.0, 0.0, 0) == PACINI_INVALID);
    require(pacini_group_set(engine, 0, PACINI_TONES, 1.0, 0.0, 0));
    require(pacini_play_seek(play, 0.9, 0));
    require(pacini_play_pause(play, 0.0, 0));
    rendered(engine, 200);
    CHECK(infoOf(play).state == PACINI_PAUSED);
    require(pacini_play_resume(play, 0.0, 0));
    require(pacini_play_stop(play, 0.01, 0));
    rendered(engine, 400);
    CHECK(infoOf(play).state == PACINI_ENDED);
    CHECK(pacini_play_set(play, PACINI_GAIN, 1.0, 0.0, 0) == PACINI_STALE);
    CHECK(lastError() == "play: has ended");

    pacini_engine_info state;
    pacini_engine_info_init(&state);
    require(pacini_engine_get_info(engine, &state));
    CHECK(state.frame == 1000 + 1000 + 200 + 500 + 400 + 1000 + 1400 + 1400 + 200 + 400);
    CHECK(state.latency == 8);
    CHECK(state.playing == 0);
    require(pacini_engine_destroy(engine));
    require(pacini_clip_release(clip));
}

TEST_CASE("Handles that are stale or of another kind are errors, also after their place is used again")
{
    const pacini_clip clip = loaded(hum);
    const pacini_engine engine = created();
    pacini_play play = PACINI_NONE;
    require(pacini_play_start(engine, clip, nullptr, &play));
    pacini_play_info info;
    pacini_play_info_init(&info);
    // Numbers of another kind, which only who makes a handle of them can pass.
    for (const std::uint64_t other : {std::uint64_t(0), engine.id, clip.id, play.id + 1, ~play.id, ~std::uint64_t(0)})
    {
        CHECK(pacini_play_stop({other}, 0.0, 0) == PACINI_STALE);
        if (other != play.id + 1)
            CHECK(pacini_play_get_info({other}, &info) == PACINI_STALE);
    }
    for (const std::uint64_t other : {std::uint64_t(0), play.id, clip.id, engine.id + 2, ~std::uint64_t(0)})
    {
        std::array<float, 8> samples;
        samples.fill(1.0f);
        CHECK(pacini_render_interleaved({other}, samples.data(), 1, 8) == PACINI_STALE);
        CHECK(std::all_of(samples.begin(), samples.end(), [](float v) { return v == 0.0f; })); // not what was there
        CHECK(pacini_engine_destroy({other}) == PACINI_STALE);
        CHECK(pacini_play_start({other}, clip, nullptr, nullptr) == PACINI_STALE);
        CHECK(pacini_play_start(engine, {other}, nullptr, nullptr) == (other == clip.id ? PACINI_OK : PACINI_STALE));
    }
    require(pacini_engine_destroy(engine));
    CHECK(pacini_engine_destroy(engine) == PACINI_STALE);
    const pacini_engine again = created();
    CHECK(again != engine);
    pacini_play newer = PACINI_NONE;
    require(pacini_play_start(again, clip, nullptr, &newer));
    CHECK(newer != play);
    CHECK(pacini_play_get_info(play, &info) == PACINI_STALE);
    require(pacini_clip_release(clip));
    CHECK(pacini_clip_release(clip) == PACINI_STALE);
    CHECK(largest(rendered(again, 2000)) > 0.4f); // what plays goes on
    require(pacini_engine_destroy(again));
}

namespace
{
const std::string marked = R"({"format": "pacini.clip", "version": 1, "name": "marked", "duration": 2, "bands": [],
 "markers": [{"time": 0.5, "name": "loop start"}, {"time": 0.75, "name": "step"}, {"time": 1.25, "name": "step"},
 {"time": 1.5, "name": "loop end"}, {"time": 2, "name": "LONG"}]})";

pacini_marker_info markerOf(pacini_clip clip, std::uint32_t index)
{
    pacini_marker_info info;
    pacini_marker_info_init(&info);
    require(pacini_clip_get_marker(clip, index, &info));
    return info;
}
} // namespace

TEST_CASE("Markers of a clip are read through C by number and by name")
{
    // 127 bytes hold 63 characters of two bytes, and no half.
    std::string text = marked, name;
    for (int i = 0; i < 70; ++i)
        name += "\u00fc";
    text.replace(text.find("LONG"), 4, name);
    const pacini_clip clip = loaded(text);
    std::uint32_t count = 9;
    require(pacini_clip_count_markers(clip, &count));
    REQUIRE(count == 5);
    const std::array<double, 5> times{0.5, 0.75, 1.25, 1.5, 2.0};
    for (std::uint32_t i = 0; i < count; ++i)
    {
        CHECK(markerOf(clip, i).index == i);
        CHECK(markerOf(clip, i).time == Approx(times[i]).margin(1e-3));
    }
    CHECK(std::string(markerOf(clip, 3).name) == "loop end");
    CHECK(std::string(markerOf(clip, 4).name) == name.substr(0, 126));

    pacini_marker_info info;
    pacini_marker_info_init(&info);
    require(pacini_clip_find_marker(clip, "step", 0, &info));
    CHECK(info.index == 1);
    require(pacini_clip_find_marker(clip, "step", info.index + 1, &info));
    CHECK(info.index == 2);
    require(pacini_clip_find_marker(clip, name.c_str(), 0, &info));
    CHECK(info.index == 4);

    // What fails writes nothing.
    const pacini_marker_info before = info;
    CHECK(pacini_clip_find_marker(clip, "step", 3, &info) == PACINI_INVALID);
    CHECK(lastError() == "name: there is no marker 'step' from there on");
    CHECK(pacini_clip_find_marker(clip, "", 0, &info) == PACINI_INVALID);
    CHECK(pacini_clip_find_marker(clip, nullptr, 0, &info) == PACINI_INVALID);
    CHECK(pacini_clip_get_marker(clip, 5, &info) == PACINI_INVALID);
    CHECK(lastError() == "index: must be less than the number of markers, which is 5");
    CHECK(pacini_clip_get_marker({~clip.id}, 0, &info) == PACINI_STALE);
    CHECK(pacini_clip_find_marker({~clip.id}, "step", 0, &info) == PACINI_STALE);
    CHECK(pacini_clip_count_markers({~clip.id}, &count) == PACINI_STALE);
    CHECK(pacini_clip_count_markers(clip, nullptr) == PACINI_INVALID);
    CHECK(pacini_clip_get_marker(clip, 0, nullptr) == PACINI_INVALID);
    CHECK(std::memcmp(&info, &before, sizeof info) == 0);
    CHECK(count == 5);

    // They are those of the content that is there.
    require(pacini_clip_reload(clip, hum.data(), hum.size()));
    require(pacini_clip_count_markers(clip, &count));
    CHECK(count == 0);
    CHECK(pacini_clip_get_marker(clip, 0, &info) == PACINI_INVALID);
    require(pacini_clip_release(clip));
}

TEST_CASE("Handles are compared in C++")
{
    const pacini_clip none = PACINI_NONE, one = loaded(hum), other = loaded(hum);
    CHECK(none == pacini_clip{0});
    CHECK(one != none);
    CHECK(one != other);
    CHECK(none < one);
    CHECK((one < other) != (other < one));
    std::map<pacini_clip, std::string> names{{one, "one"}, {other, "other"}};
    CHECK(names[one] == "one");
    CHECK(names.size() == 2);
    require(pacini_clip_release(one));
    require(pacini_clip_release(other));
}

TEST_CASE("Many clips are loaded by one call, all or none")
{
    const std::string broken = hum.substr(0, hum.size() / 2);
    std::array<const void*, 3> bytes{hum.data(), faintHum.data(), hum.data()};
    std::array<std::size_t, 3> sizes{hum.size(), faintHum.size(), hum.size()};
    constexpr std::array<pacini_clip, 3> numbered{{{1}, {2}, {3}}};
    std::array<pacini_clip, 3> clips = numbered;
    require(pacini_clips_load(nullptr, nullptr, 0, nullptr));
    require(pacini_clips_load(bytes.data(), sizes.data(), 3, clips.data()));
    const std::array<const char*, 3> names{"hum", "faint", "hum"};
    for (std::size_t i = 0; i < 3; ++i)
    {
        pacini_clip_info info;
        pacini_clip_info_init(&info);
        require(pacini_clip_get_info(clips[i], &info));
        CHECK(std::string(info.name) == names[i]);
        for (std::size_t k = 0; k < i; ++k)
            CHECK(clips[i] != clips[k]);
        require(pacini_clip_release(clips[i]));
    }
    // The first one that is broken is told, nothing is loaded, and no handle is written.
    const auto placeOf = [](pacini_clip clip)
    {
        return clip.id >> 32 & 0xFFFFFFu;
    };
    const pacini_clip before = loaded(hum);
    require(pacini_clip_release(before));
    bytes[1] = broken.data();
    sizes[1] = broken.size();
    bytes[2] = broken.data();
    sizes[2] = 1;
    clips = numbered;
    CHECK(pacini_clips_load(bytes.data(), sizes.data(), 3, clips.data()) == PACINI_BAD_DATA);
    CHECK(lastError().find("bytes[1]: ") == 0);
    CHECK(clips == numbered);
    // The next clip takes the place that was free before.
    const pacini_clip next = loaded(hum);
    CHECK(placeOf(next) == placeOf(before));
    require(pacini_clip_release(next));
}

TEST_CASE("Wrong arguments are told by name")
{
    pacini_engine_config config;
    pacini_engine_config_init(&config);
    pacini_engine engine = {1};
    const auto says = [&](const std::string& text)
    {
        CHECK(pacini_engine_create(&config, &engine) != PACINI_OK);
        CHECK(engine.id == 1);
        CHECK(lastError().find(text) != std::string::npos);
        pacini_engine_config_init(&config);
    };
    config.sample_rate = std::nan("");
    says("sample_rate: must be");
    config.actuator_count = 17;
    says("actuator_count: must be 1 to 16");
    config.actuators[0].profile = "lra-176";
    says("actuators[0].profile: 'lra-176' is no profile that comes with Pacini; there are flat-pcm");
    config.actuators[0].profile = "{\"format\": 1}";
    says("actuators[0].profile");
    config.struct_size = 0;
    says("pacini_engine_config_init()");
    pacini_clip clip = {1};
    CHECK(pacini_clip_load("nonsense", 8, &clip) == PACINI_BAD_DATA);
    CHECK(clip.id == 1);
    CHECK(pacini_clip_load(hum.data(), hum.size() / 2, &clip) == PACINI_BAD_DATA);
    CHECK(pacini_clip_load_file("there/is/none", &clip) == PACINI_IO);
    CHECK(lastError().find("there/is/none") != std::string::npos);
    CHECK(pacini_clip_load(nullptr, 3, &clip) == PACINI_INVALID);
    // What only an encoder can translate is told, and what to do.
    const std::string wave = R"({"version": "2024", "profile": "Main", "level": 1, "date": "", "description": "",
        "timescale": 1000, "avatars": [], "syncs": [], "perceptions": [{"id": 0, "perception_modality": "Vibrotactile",
        "channels": [{"id": 0, "gain": 1, "bands": [{"band_type": "WaveletWave", "lower_frequency_limit": 0,
        "upper_frequency_limit": 8000, "block_length": 128, "effects": [{"effect_type": "Basis", "position": 0,
        "wavelet_stream": "AAAA"}]}]}]}]})";
    CHECK(pacini_clip_load(wave.data(), wave.size(), &clip) == PACINI_BAD_DATA);
    CHECK(lastError().find("pacini convert") != std::string::npos);
    CHECK(clip.id == 1);
    CHECK(pacini_render(PACINI_NONE, nullptr, 1, 1) == PACINI_INVALID);
    // A caller of an older header has a shorter struct: what it does not know stays as usual.
    config.struct_size = 8;
    config.actuator_count = 3;
    config.sample_rate = -1.0;
    require(pacini_engine_create(&config, &engine));
    require(pacini_engine_destroy(engine));
}

TEST_CASE("Channels beyond the actuators are silent, and interleaved is the same")
{
    const pacini_clip clip = loaded(hum);
    const pacini_engine a = created(2);
    const pacini_engine b = created(2);
    require(pacini_play_start(a, clip, nullptr, nullptr));
    require(pacini_play_start(b, clip, nullptr, nullptr));
    std::vector<float> x(1000, 9.0f), y(1000, 9.0f), z(1000, 9.0f), mixed(3000, 9.0f);
    float* channels[] = {x.data(), y.data(), z.data()};
    require(pacini_render(a, channels, 3, 1000));
    require(pacini_render_interleaved(b, mixed.data(), 3, 1000));
    CHECK(largest(z) == 0.0f);
    CHECK(largest(x) > 0.3f);
    for (std::size_t i = 0; i < 1000; ++i)
    {
        REQUIRE(mixed[3 * i] == x[i]);
        REQUIRE(mixed[3 * i + 1] == y[i]);
        REQUIRE(mixed[3 * i + 2] == 0.0f);
    }
    require(pacini_engine_destroy(a));
    require(pacini_engine_destroy(b));
    require(pacini_clip_release(clip));
}

TEST_CASE("An engine may be destroyed while another thread renders it")
{
    const pacini_clip clip = loaded(hum);
    for (int i = 0; i < 50; ++i)
    {
        const pacini_engine engine = created();
        require(pacini_play_start(engine, clip, nullptr, nullptr));
        std::thread audio(
            [engine]
            {
                std::array<float, 64> samples;
                while (pacini_render_interleaved(engine, samples.data(), 1, 64) == PACINI_OK)
                {
                }
            });
        std::this_thread::yield();
        require(pacini_engine_destroy(engine));
        audio.join();
    }
    require(pacini_clip_release(clip));
}

// What is freed while it is read shows with a sanitizer, and as a state that is not the play's own.
TEST_CASE("Plays that end on the audio thread while others start in their slots keep their own states")
{
    const pacini_clip clip = loaded(hum);
    const pacini_engine engine = created();
    std::atomic<bool> ends{false};
    std::thread audio(
        [&]
        {
            std::vector<float> out(16);
            float* channels[] = {out.data()};
            while (!ends)
                pacini_render(engine, channels, 1, 16);
        });
    pacini_play_settings settings;
    pacini_play_settings_init(&settings);
    settings.from = 0.99;
    for (int i = 0; i < 3000; ++i)
    {
        pacini_play play = PACINI_NONE;
        if (pacini_play_start(engine, clip, &settings, &play) != PACINI_OK)
            continue; // as many as there may be
        settings.from = i % 100 == 0 ? 0.0 : 0.99;
        if (settings.from == 0.0)
            continue;
        const int state = infoOf(play).state;
        CHECK((state == PACINI_WAITING || state == PACINI_PLAYING || state == PACINI_ENDED));
    }
    ends = true;
    audio.join();
    require(pacini_engine_destroy(engine));
    require(pacini_clip_release(clip));
}

TEST_CASE("Controllers that are not there, and engines without one, are errors that change nothing")
{
    std::uint32_t count = 1;
    require(pacini_controllers_find(nullptr, 0, &count));
    std::vector<pacini_controller> found(count + 1);
    require(pacini_controllers_find(found.data(), count + 1, &count));
    CHECK(pacini_controllers_find(nullptr, 1, &count) == PACINI_INVALID);
    CHECK(pacini_controllers_find(found.data(), 1, nullptr) == PACINI_INVALID);

    const pacini_engine engine = created();
    pacini_controller_info of;
    pacini_controller_info_init(&of);
    for (const std::uint64_t wrong : {std::uint64_t{0}, engine.id, ~std::uint64_t{0}})
    {
        CHECK(pacini_controller_get_info({wrong}, &of) == PACINI_STALE);
        CHECK(pacini_engine_attach(engine, {wrong}, nullptr) == PACINI_STALE);
    }
    CHECK(lastError() == "controller is not in use (any more)");
    CHECK(pacini_engine_detach(engine) == PACINI_INVALID);
    CHECK(lastError() == "engine: plays on no controller");
    pacini_attachment_info info;
    pacini_attachment_info_init(&info);
    require(pacini_engine_get_attachment(engine, &info));
    CHECK(info.state == PACINI_DETACHED);
    CHECK(info.controller.id == 0);
    CHECK(pacini_engine_get_attachment(engine, nullptr) == PACINI_INVALID);
    CHECK(rendered(engine, 10).size() == 10); // it is still the caller's
    require(pacini_engine_destroy(engine));
    CHECK(pacini_engine_detach(engine) == PACINI_STALE);
    CHECK(pacini_engine_get_attachment(engine, &info) == PACINI_STALE);
    CHECK(pacini_api_version() == 1005);
}

namespace
{
/// Random numbers by a fixed seed.
struct Dice
{
    std::uint64_t state = 20261127;

    std::uint64_t below(std::uint64_t most)
    {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        return state % most;
    }

    /// A number that is not `low` to `high`.
    double outside(double low, double high)
    {
        constexpr double infinite = std::numeric_limits<double>::infinity();
        const std::array<double, 8> wrong{std::nan(""),
                                          infinite,
                                          -infinite,
                                          1e300,
                                          -1e300,
                                          std::nextafter(low, -infinite),
                                          std::nextafter(high, infinite),
                                          below(2) == 0 ? low - 0.001 * static_cast<double>(1 + below(1000))
                                                        : high * 1.5 + 1.0};
        return wrong[below(wrong.size())];
    }
};

/// A number of a struct, where it must be, and how errors call it.
template <typename Struct>
struct Field
{
    const char* name;
    double Struct::*member;
    double low, high;
};

constexpr std::array<Field<pacini_play_settings>, 11> settingFields{{
    {"gain", &pacini_play_settings::gain, 0.0, 1000.0},
    {"intensity", &pacini_play_settings::intensity, 0.0, 1.0},
    {"pan", &pacini_play_settings::pan, 0.0, 1.0},
    {"delay", &pacini_play_settings::delay, 0.0, 0.25},
    {"transposition", &pacini_play_settings::transposition, -96.0, 96.0},
    {"speed", &pacini_play_settings::speed, 0.01, 100.0},
    {"from", &pacini_play_settings::from, 0.0, 86400.0},
    {"loop", &pacini_play_settings::loop, -1.0, 1.0}, // as long as the clip
    {"headroom", &pacini_play_settings::headroom, 0.0, 48.0},
    {"fade_in", &pacini_play_settings::fade_in, 0.0, 3600.0},
    {"variation", &pacini_play_settings::variation, 0.0, 1.0},
}};

constexpr std::array<Field<pacini_engine_config>, 5> configFields{{
    {"sample_rate", &pacini_engine_config::sample_rate, 2000.0, 768000.0},
    {"pan_delay", &pacini_engine_config::pan_delay, 0.0, 0.1},
    {"longest_delay", &pacini_engine_config::longest_delay, 0.0, 1.0},
    {"strength", &pacini_engine_config::strength, 0.0, 1.0},
    {"budget", &pacini_engine_config::budget, 0.0, 1e6},
}};

struct Control
{
    const char* name;
    double low, high;
};

/// By their numbers.
constexpr std::array<Control, 10> controls{{{"gain", 0.0, 1000.0},
                                            {"intensity", 0.0, 1.0},
                                            {"pan", 0.0, 1.0},
                                            {"delay", 0.0, 0.25},
                                            {"transposition", -96.0, 96.0},
                                            {"speed", 0.01, 100.0},
                                            {"priority", -1e9, 1e9},
                                            {"tones", 0.0, 1000.0},
                                            {"events", 0.0, 1000.0},
                                            {"noise", 0.0, 1000.0}}};

bool hasCamelCase(const std::string& text)
{
    for (std::size_t i = 0; i + 1 < text.size(); ++i)
        if (text[i] >= 'a' && text[i] <= 'z' && text[i + 1] >= 'A' && text[i + 1] <= 'Z')
            return true;
    return false;
}

/// What a failed call may not write to.
constexpr std::uint64_t untouched = 0x1234567890ABCDEF;
} // namespace

TEST_CASE("A thousand calls with something wrong in each name it and change nothing")
{
    Dice dice;
    const pacini_clip clip = loaded(hum);
    // The same is played by both; only one gets the calls.
    const std::array<pacini_engine, 2> engines{created(2), created(2)};
    std::array<pacini_play, 2> plays{};
    pacini_play_settings settings;
    pacini_play_settings_init(&settings);
    settings.loop = -1.0;
    for (std::size_t i = 0; i < 2; ++i)
        require(pacini_play_start(engines[i], clip, &settings, &plays[i]));
    const pacini_engine engine = engines[0];
    const pacini_play play = plays[0];
    const pacini_engine gone = created();
    require(pacini_engine_destroy(gone));

    pacini_engine madeEngine = {untouched};
    pacini_clip madeClip = {untouched};
    pacini_play madePlay = {untouched};
    std::array<int, 20> told{};
    const auto fails = [&](std::size_t kind, pacini_result code, pacini_result result, const std::string& name)
    {
        INFO("call of kind " << kind << ": " << pacini_result_text(result) << ", " << lastError() << "; " << name);
        REQUIRE(result == code);
        REQUIRE(lastError().find(name) != std::string::npos);
        REQUIRE(madeEngine.id == untouched);
        REQUIRE(madeClip.id == untouched);
        REQUIRE(madePlay.id == untouched);
        // No name of C++: what is wrong is called as pacini.h has it. Keys of files are those of the file.
        const std::string said = lastError();
        REQUIRE((result == PACINI_BAD_DATA || !hasCamelCase(said)));
        ++told[kind];
    };
    for (int i = 0; i < 1000; ++i)
    {
        const auto kind = static_cast<std::size_t>(dice.below(told.size()));
        const auto c = static_cast<std::size_t>(dice.below(controls.size()));
        const auto number = static_cast<std::int32_t>(c);
        const auto frame = static_cast<std::int64_t>(dice.below(2) == 0 ? 0 : dice.below(1u << 30));
        const double value = dice.outside(controls[c].low, controls[c].high), fine = controls[c].high;
        const double fade = dice.outside(0.0, 3600.0);
        const std::array<std::uint64_t, 5> strangers{0, gone.id, clip.id, untouched, ~std::uint64_t{0}};
        const std::uint64_t stranger = strangers[dice.below(strangers.size())];
        switch (kind)
        {
        case 0:
            fails(kind, PACINI_INVALID, pacini_play_set(play, number, value, 0.0, frame), controls[c].name);
            break;
        case 1:
            fails(kind, PACINI_INVALID, pacini_play_set(play, number, fine, fade, frame), "glide: must be 0 to 3600 s");
            break;
        case 2:
            fails(kind, PACINI_INVALID, pacini_group_set(engine, 0, number, value, 0.0, frame), controls[c].name);
            break;
        case 3:
            fails(kind, PACINI_INVALID, pacini_group_set(engine, 0, number, fine, fade, frame), "glide");
            break;
        case 4:
            fails(kind, PACINI_INVALID, pacini_play_stop(play, fade, frame), "fade: must be 0 to 3600 s");
            break;
        case 5:
            fails(kind, PACINI_INVALID, pacini_play_pause(play, fade, frame), "fade");
            break;
        case 6:
            fails(kind, PACINI_INVALID, pacini_play_resume(play, fade, frame), "fade");
            break;
        case 7:
            fails(kind, PACINI_INVALID, pacini_group_stop(engine, 0, fade, frame), "fade");
            break;
        case 8:
            fails(kind, PACINI_INVALID, pacini_play_seek(play, dice.outside(0.0, 86400.0), frame), "position");
            break;
        case 9:
            fails(kind, PACINI_INVALID, pacini_engine_set_actuator_gain(engine, 1, dice.outside(0.0, 1.0), 0.0, frame),
                  "value");
            fails(kind, PACINI_INVALID, pacini_engine_set_actuator_gain(engine, 1, 0.5, fade, frame), "glide");
            fails(kind, PACINI_INVALID, pacini_engine_set_actuator_gain(engine, 2, 0.5, 0.0, frame), "actuator");
            break;
        case 10:
            fails(kind, PACINI_INVALID, pacini_engine_set_budget(engine, dice.outside(0.0, 1e6), 512, 1), "budget");
            fails(kind, PACINI_INVALID, pacini_engine_set_budget(engine, 1.0, 0, 1), "budget");
            fails(kind, PACINI_INVALID, pacini_engine_calibrate(engine, dice.outside(0.01, 100.0), nullptr), "factor");
            break;
        case 11:
        {
            const auto& field = settingFields[dice.below(settingFields.size())];
            pacini_play_settings wrong = settings;
            wrong.*field.member = dice.outside(field.low, field.high);
            fails(kind, PACINI_INVALID, pacini_play_start(engine, clip, &wrong, &madePlay), field.name);
            break;
        }
        case 12:
        {
            const auto& field = configFields[dice.below(configFields.size())];
            pacini_engine_config config;
            pacini_engine_config_init(&config);
            config.*field.member = dice.outside(field.low, field.high);
            fails(kind, PACINI_INVALID, pacini_engine_create(&config, &madeEngine), field.name);
            pacini_engine_config_init(&config);
            config.actuator_count = 2;
            (dice.below(2) == 0 ? config.actuators[1].gain : config.actuators[1].delay) = dice.outside(0.0, 1.0);
            fails(kind, PACINI_INVALID, pacini_engine_create(&config, &madeEngine), "actuators[1].");
            break;
        }
        case 13:
        {
            pacini_engine_config config;
            pacini_engine_config_init(&config);
            const std::array<std::uint32_t, 3> wrong{0, 1'000'001, ~0u};
            const std::uint32_t count = wrong[dice.below(3)];
            const std::array<std::pair<std::uint32_t*, const char*>, 3> counts{
                {{&config.actuator_count, "actuator_count"},
                 {&config.max_plays, "max_plays"},
                 {&config.max_commands, "max_commands"}}};
            const auto& [member, name] = counts[dice.below(3)];
            *member = count;
            fails(kind, PACINI_INVALID, pacini_engine_create(&config, &madeEngine), name);
            pacini_engine_config_init(&config);
            config.budget_frames = 0;
            fails(kind, PACINI_INVALID, pacini_engine_create(&config, &madeEngine), "budget");
            pacini_engine_config_init(&config);
            config.pan_law = dice.below(2) == 0 ? -1 : 3;
            fails(kind, PACINI_INVALID, pacini_engine_create(&config, &madeEngine), "pan_law");
            pacini_engine_config_init(&config);
            config.struct_size =
                static_cast<std::uint32_t>(dice.below(2) == 0 ? dice.below(4) : 4097 + dice.below(1u << 31));
            fails(kind, PACINI_INVALID, pacini_engine_create(&config, &madeEngine), "pacini_engine_config_init()");
            fails(kind, PACINI_IO, pacini_engine_create_scene(nullptr, "there/is/none", &madeEngine), "there/is/none");
            break;
        }
        case 14:
        {
            const std::size_t some = 1 + static_cast<std::size_t>(dice.below(hum.size() - 2));
            fails(kind, PACINI_BAD_DATA, pacini_clip_load(hum.data(), some, &madeClip), "");
            fails(kind, PACINI_BAD_DATA, pacini_clip_reload(clip, hum.data(), some), "");
            fails(kind, PACINI_INVALID, pacini_clip_load(hum.data(), 0, &madeClip), "bytes");
            fails(kind, PACINI_INVALID, pacini_clip_load(hum.data(), hum.size(), nullptr), "clip");
            fails(kind, PACINI_IO, pacini_clip_load_file("there/is/none", &madeClip), "there/is/none");
            const std::array<const void*, 2> both{hum.data(), hum.data()};
            std::array<std::size_t, 2> sizes{hum.size(), some};
            fails(kind, PACINI_BAD_DATA, pacini_clips_load(both.data(), sizes.data(), 2, &madeClip), "bytes[1]");
            sizes[1] = 0;
            fails(kind, PACINI_INVALID, pacini_clips_load(both.data(), sizes.data(), 2, &madeClip), "bytes[1]: there");
            fails(kind, PACINI_INVALID, pacini_clips_load(both.data(), nullptr, 2, &madeClip), "sizes");
            fails(kind, PACINI_TOO_MANY, pacini_clips_load(both.data(), sizes.data(), ~std::size_t{0}, &madeClip),
                  "count");
            break;
        }
        case 15:
        {
            fails(kind, PACINI_STALE, pacini_play_start({stranger}, clip, nullptr, &madePlay), "engine");
            if (stranger != clip.id)
                fails(kind, PACINI_STALE, pacini_play_start(engine, {stranger}, nullptr, &madePlay), "clip");
            fails(kind, PACINI_STALE, pacini_play_set({stranger}, number, fine, 0.0, frame), "play");
            fails(kind, PACINI_STALE, pacini_engine_attach(engine, {stranger}, nullptr), "controller");
            if (stranger != clip.id)
                fails(kind, PACINI_STALE, pacini_clip_reload({stranger}, hum.data(), hum.size()), "clip");
            float* none = nullptr;
            CHECK(pacini_render({stranger}, &none, 0, 8) == PACINI_STALE);
            CHECK(pacini_render({stranger}, nullptr, 0, 0) == PACINI_STALE);
            CHECK(pacini_render_interleaved({stranger}, nullptr, 0, 0) == PACINI_STALE);
            CHECK(pacini_render(engine, &none, 1, 8) == PACINI_INVALID);
            CHECK(pacini_render_interleaved(engine, nullptr, 1, 8) == PACINI_INVALID);
            break;
        }
        case 16:
        {
            const std::int32_t none = dice.below(2) == 0 ? -1 : PACINI_TEXTURE_FORCE + 1;
            fails(kind, PACINI_INVALID, pacini_play_set(play, none, 0.5, 0.0, frame), "control");
            fails(kind, PACINI_INVALID, pacini_group_set(engine, 0, none, 0.5, 0.0, frame), "control");
            fails(kind, PACINI_INVALID, pacini_play_set(play, PACINI_PRIORITY, 0.5, 0.0, frame), "whole");
            const auto group = static_cast<std::uint32_t>(32 + dice.below(1u << 31));
            fails(kind, PACINI_INVALID, pacini_group_set(engine, group, number, fine, 0.0, frame), "group");
            fails(kind, PACINI_INVALID, pacini_group_stop(engine, group, 0.0, frame), "group");
            pacini_play_settings wrong = settings;
            wrong.group = group;
            fails(kind, PACINI_INVALID, pacini_play_start(engine, clip, &wrong, &madePlay), "group");
            wrong = settings;
            wrong.priority = std::numeric_limits<std::int32_t>::min();
            fails(kind, PACINI_INVALID, pacini_play_start(engine, clip, &wrong, &madePlay), "priority");
            break;
        }
        case 17:
        {
            pacini_play_info info;
            std::memset(&info, 0x5A, sizeof info);
            info.struct_size = dice.below(2) == 0 ? 0 : 5000;
            const pacini_play_info before = info;
            fails(kind, PACINI_INVALID, pacini_play_get_info(play, &info), "init");
            fails(kind, PACINI_STALE, pacini_play_get_info({stranger}, &info), "play");
            CHECK(std::memcmp(&info, &before, sizeof info) == 0);
            fails(kind, PACINI_INVALID, pacini_engine_get_info(engine, nullptr), "init");
            fails(kind, PACINI_INVALID, pacini_clip_get_info(clip, nullptr), "init");
            pacini_marker_info marker;
            pacini_marker_info_init(&marker);
            const auto index = static_cast<std::uint32_t>(dice.below(1u << 31));
            fails(kind, PACINI_INVALID, pacini_clip_get_marker(clip, index, &marker), "index");
            fails(kind, PACINI_INVALID, pacini_clip_find_marker(clip, "none", index, &marker), "name");
            fails(kind, PACINI_STALE, pacini_clip_find_marker({untouched}, "none", index, &marker), "clip");
            fails(kind, PACINI_INVALID, pacini_clip_count_markers(clip, nullptr), "count");
            break;
        }
        case 18:
        {
            std::uint32_t count = 77;
            fails(kind, PACINI_INVALID, pacini_controllers_find(nullptr, 1, &count), "controllers");
            CHECK(count == 77);
            fails(kind, PACINI_INVALID, pacini_engine_detach(engine), "no controller");
            break;
        }
        default:
        {
            std::array<std::vector<float>, 2> heard{rendered(engines[0], 100), rendered(engines[1], 100)};
            REQUIRE(heard[0] == heard[1]);
            ++told[kind];
        }
        }
    }
    CHECK(*std::min_element(told.begin(), told.end()) > 10);
    CHECK(rendered(engines[0], 8000) == rendered(engines[1], 8000));
    CHECK(infoOf(plays[0]).position == infoOf(plays[1]).position);
    for (const pacini_engine each : engines)
        require(pacini_engine_destroy(each));
    require(pacini_clip_release(clip));
}

namespace
{
/// An engine with 24 hums at different places, whose first blocks have been rendered.
pacini_engine humming(double budget, double factor)
{
    pacini_engine_config config;
    pacini_engine_config_init(&config);
    config.actuator_count = 2;
    config.budget = budget;
    config.budget_frames = 256;
    pacini_engine engine = PACINI_NONE;
    require(pacini_engine_create(&config, &engine));
    require(pacini_engine_calibrate(engine, factor, nullptr));
    const pacini_clip clip = loaded(hum);
    for (int i = 0; i < 24; ++i)
    {
        pacini_play_settings settings;
        pacini_play_settings_init(&settings);
        settings.loop = -1.0;
        settings.pan = i / 23.0;
        settings.gain = 0.01 * (i + 1);
        require(pacini_play_start(engine, clip, &settings, nullptr));
    }
    require(pacini_clip_release(clip));
    return engine;
}

pacini_engine_info engineInfo(pacini_engine engine)
{
    pacini_engine_info info;
    pacini_engine_info_init(&info);
    require(pacini_engine_get_info(engine, &info));
    return info;
}

/// Share of blocks of 256 frames that take longer than `microseconds`.
double shareBeyond(pacini_engine engine, double microseconds, int blocks)
{
    std::vector<float> samples(512);
    int beyond = 0;
    for (int i = 0; i < blocks; ++i)
    {
        const auto start = std::chrono::steady_clock::now();
        require(pacini_render_interleaved(engine, samples.data(), 2, 256));
        const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - start;
        beyond += taken.count() > microseconds ? 1 : 0;
    }
    return static_cast<double>(beyond) / blocks;
}
} // namespace

TEST_CASE("A factor of time is a factor of the cost, and the budget counts with it")
{
    const pacini_engine one = humming(0.0, 1.0), three = humming(0.0, 3.0);
    shareBeyond(one, 0.0, 8);
    shareBeyond(three, 0.0, 8);
    const double cost = engineInfo(one).cost;
    CHECK(engineInfo(three).cost == Approx(3.0 * cost));
    // The same factor leaves out the same plays, each time; a budget set before or after it is the same.
    const pacini_engine limited = humming(1.5 * cost, 3.0), again = humming(1.5 * cost, 1.0);
    require(pacini_engine_calibrate(again, 3.0, nullptr));
    for (const pacini_engine engine : {limited, again})
    {
        shareBeyond(engine, 0.0, 8);
        CHECK(engineInfo(engine).left_out >= 12);
        CHECK(engineInfo(engine).left_out <= 16);
        CHECK(engineInfo(engine).cost <= 1.5 * cost);
    }
    CHECK(engineInfo(limited).left_out == engineInfo(again).left_out);
    require(pacini_engine_set_budget(again, 2.0 * cost, 256, 0));
    shareBeyond(again, 0.0, 8);
    CHECK(engineInfo(again).left_out >= 7);
    CHECK(engineInfo(again).left_out <= 11);
    for (const pacini_engine engine : {one, three, limited, again})
        require(pacini_engine_destroy(engine));
}

TEST_CASE("With a factor that is measured most blocks keep within their budget")
{
    const pacini_engine engine = humming(0.0, 1.0);
    double factor = 7.0;
    CHECK(pacini_engine_calibrate(engine, 0.0, &factor) == PACINI_INVALID);
    CHECK(lastError().find("64 blocks") != std::string::npos);
    CHECK(factor == 7.0);
    // Other programs may take the processor away between the one measurement and the other.
    double beyond = 1.0;
    for (int attempt = 0; attempt < 5 && beyond > 0.25; ++attempt)
    {
        shareBeyond(engine, 0.0, 300);
        require(pacini_engine_calibrate(engine, 0.0, &factor));
        beyond = shareBeyond(engine, engineInfo(engine).cost, 300);
    }
    INFO("factor " << factor << ", share of blocks that take longer than predicted " << beyond);
    CHECK(beyond <= 0.25);
    CHECK(shareBeyond(engine, 0.1 * engineInfo(engine).cost, 300) > 0.5);
    // What was measured can be kept.
    const double cost = engineInfo(engine).cost;
    require(pacini_engine_calibrate(engine, 1.0, nullptr));
    require(pacini_engine_calibrate(engine, factor, nullptr));
    CHECK(engineInfo(engine).cost == cost);
    require(pacini_engine_destroy(engine));
    CHECK(pacini_engine_calibrate(engine, 1.0, &factor) == PACINI_STALE);
}

TEST_CASE("A command for which there is no room leaves the play and the clip as they were, in every engine")
{
    const pacini_clip clip = loaded(hum);
    pacini_engine_config config;
    pacini_engine_config_init(&config);
    config.sample_rate = 8000.0;
    config.max_commands = 16;
    std::array<pacini_engine, 2> engines{};
    std::array<pacini_play, 2> plays{};
    pacini_play_settings settings;
    pacini_play_settings_init(&settings);
    settings.loop = -1.0;
    for (std::size_t i = 0; i < 2; ++i)
    {
        require(pacini_engine_create(&config, &engines[i]));
        require(pacini_play_start(engines[i], clip, &settings, &plays[i]));
        rendered(engines[i], 400);
    }
    int sent = 0;
    while (pacini_play_set(plays[1], PACINI_PAN, 0.5, 0.0, 0) == PACINI_OK)
        ++sent;
    REQUIRE(sent >= 16);
    CHECK(pacini_play_set(plays[1], PACINI_GAIN, 0.0, 0.0, 0) == PACINI_TOO_MANY);
    CHECK(pacini_clip_reload(clip, faintHum.data(), faintHum.size()) == PACINI_TOO_MANY);
    CHECK(lastError().find("commands") != std::string::npos);
    pacini_clip_info info;
    pacini_clip_info_init(&info);
    require(pacini_clip_get_info(clip, &info));
    CHECK(std::string(info.name) == "hum");
    for (std::size_t i = 0; i < 2; ++i)
    {
        rendered(engines[i], 400);
        CHECK(largest(rendered(engines[i], 1000)) > 0.4f);
        require(pacini_play_seek(plays[i], 0.0, 0)); // it is made anew, with what was set
        rendered(engines[i], 400);
        CHECK(largest(rendered(engines[i], 1000)) > 0.4f);
    }
    require(pacini_clip_reload(clip, faintHum.data(), faintHum.size()));
    for (const pacini_engine engine : engines)
    {
        rendered(engine, 400);
        CHECK(largest(rendered(engine, 1000)) == Approx(0.1).margin(0.02));
        require(pacini_engine_destroy(engine));
    }
    require(pacini_clip_release(clip));
}

TEST_CASE("Structs of version 1 never grow: their init functions would write beyond those of older programs")
{
    if (sizeof(void*) != 8 || sizeof(double) != alignof(double))
        return;
    for (const std::size_t size : {sizeof(pacini_clip), sizeof(pacini_engine), sizeof(pacini_texture),
                                   sizeof(pacini_play), sizeof(pacini_controller)})
        CHECK(size == 8);
    CHECK(sizeof(pacini_clip_info) == 88);
    CHECK(sizeof(pacini_marker_info) == 144);
    CHECK(sizeof(pacini_actuator) == 24);
    CHECK(sizeof(pacini_engine_config) == 456);
    CHECK(sizeof(pacini_engine_info) == 48);
    CHECK(sizeof(pacini_play_settings) == 120);
    CHECK(sizeof(pacini_play_info) == 16);
    CHECK(sizeof(pacini_controller_info) == 396);
    CHECK(sizeof(pacini_attach_settings) == 8);
    CHECK(sizeof(pacini_attachment_info) == 152);
}
