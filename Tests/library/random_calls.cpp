// Calls libpacini at random: `random_calls COUNT [SEED]` makes COUNT sequences of calls in random order, with stale and
// invented handles, NaN, infinities and huge sizes. Nothing may crash, what fails writes no handle and says why, and
// what is rendered is finite and within full drive.

#include <pacini.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace
{
std::uint64_t state = 1;
std::uint64_t started = 0;  // plays
std::uint64_t attached = 0; // seen
double strongest = 0.0;     // sample

std::uint64_t next()
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

double number()
{
    switch (next() % 10)
    {
    case 0:
        return std::numeric_limits<double>::quiet_NaN();
    case 1:
        return std::numeric_limits<double>::infinity();
    case 2:
        return -1e300;
    case 3:
        return 1e300;
    case 4:
        return -1.0;
    default:
        return static_cast<double>(next() % 1000) / 500.0;
    }
}

const std::string clipText = R"({"format": "pacini.clip", "version": 1, "duration": 0.05,
 "bands": [{"lowFrequency": 90, "centreFrequency": 100, "highFrequency": 110, "amplitude": [{"time": 0, "amplitude": 0.9}, {"time": 0.05, "amplitude": 0.1}]}],
 "transients": [{"time": 0.01, "amplitude": 0.9, "sharpness": 0.5}]})";

enum Kind
{
    clips,
    engines,
    plays,
    controllers
};

struct Handles
{
    std::array<std::vector<std::uint64_t>, 4> known{{{0}, {0}, {0, ~std::uint64_t(0)}, {0}}};

    /// One of this kind, mostly.
    std::uint64_t of(Kind kind) const
    {
        const auto& some = known[next() % 8 == 0 ? next() % 4 : static_cast<std::size_t>(kind)];
        const std::uint64_t one = some[next() % some.size()];
        return next() % 16 == 0 ? one ^ (std::uint64_t(1) << (next() % 64)) : one;
    }
    void add(Kind kind, std::uint64_t handle)
    {
        if (handle == 0)
            return;
        auto& some = known[kind];
        some.push_back(handle);
        if (some.size() <= 12)
            return;
        const auto old = some.begin() + 1 + static_cast<std::ptrdiff_t>(next() % 11);
        if (kind == engines) // there are 64 at most
            pacini_engine_destroy({*old});
        if (kind == clips)
            pacini_clip_release({*old});
        some.erase(old);
    }
};

constexpr std::uint64_t untouched = 0x1234567890ABCDEF;

/// Whether a call gave a handle, or else left the caller's alone and said why. `made` is what the call wrote, whichever
/// argument is evaluated first.
template <typename Made>
bool gaveOrSaid(pacini_result result, const Made& made)
{
    const bool well = result == PACINI_OK ? made.id != untouched && made.id != 0
                                          : made.id == untouched && pacini_last_error(nullptr, 0) > 1;
    if (!well)
        std::printf("%s, and the handle is %llx\n", pacini_result_text(result),
                    static_cast<unsigned long long>(made.id));
    return well;
}

bool rendersWell(pacini_engine engine)
{
    std::array<float, 3 * 300> samples;
    const auto channels = static_cast<std::uint32_t>(next() % 4), frames = static_cast<std::uint32_t>(next() % 301);
    pacini_render_interleaved(engine, samples.data(), channels, frames);
    for (std::size_t i = 0; i < static_cast<std::size_t>(channels) * frames; ++i)
    {
        strongest = std::max(strongest, static_cast<double>(std::abs(samples[i])));
        if (!(std::abs(samples[i]) <= 1.0f))
        {
            std::printf("sample %zu is %g\n", i, static_cast<double>(samples[i]));
            return false;
        }
    }
    return true;
}

bool sequence(Handles& handles)
{
    const std::uint64_t calls = next() % 30;
    for (std::uint64_t i = 0; i < calls; ++i)
    {
        const pacini_engine engine = {handles.of(engines)};
        const pacini_clip clip = {handles.of(clips)};
        const pacini_play play = {handles.of(plays)};
        const double x = number(), y = number();
        const auto frame = static_cast<std::int64_t>(next() % 4 == 0 ? next() : 0);
        const auto control = static_cast<std::int32_t>(next() % 12) - 1;
        switch (next() % 19)
        {
        case 0:
        {
            if (next() % 3 != 0)
                break;
            pacini_clip made = {untouched};
            if (!gaveOrSaid(pacini_clip_load(clipText.data(),
                                             next() % 4 != 0 ? clipText.size() : next() % clipText.size(), &made),
                            made))
                return false;
            if (made.id != untouched)
                handles.add(clips, made.id);
            break;
        }
        case 1:
        {
            if (next() % 4 != 0)
                break;
            pacini_engine_config config;
            pacini_engine_config_init(&config);
            config.actuator_count = 1 + static_cast<std::uint32_t>(next() % 3);
            config.sample_rate = next() % 8 == 0 ? number() : 8000.0;
            config.max_plays = next() % 8 == 0 ? static_cast<std::uint32_t>(next()) % 20000 : 8;
            config.max_commands = 32;
            config.pan_law = static_cast<std::int32_t>(next() % 4);
            config.actuators[0].profile = next() % 3 == 0 ? "lra-175" : next() % 3 == 0 ? "erm-coin" : nullptr;
            config.actuators[1].gain = next() % 8 == 0 ? number() : 0.5;
            config.actuators[1].delay = next() % 8 == 0 ? number() : 0.01;
            config.longest_delay = next() % 8 == 0 ? number() : 0.1;
            config.budget = next() % 4 == 0 ? number() : 0.0;
            pacini_engine made = {untouched};
            if (!gaveOrSaid(pacini_engine_create(&config, &made), made))
                return false;
            if (made.id != untouched)
                handles.add(engines, made.id);
            break;
        }
        case 2:
        case 3:
        case 4:
        {
            pacini_play_settings settings;
            pacini_play_settings_init(&settings);
            double* const fields[] = {&settings.gain,          &settings.intensity, &settings.pan,      &settings.delay,
                                      &settings.transposition, &settings.speed,     &settings.from,     &settings.loop,
                                      &settings.headroom,      &settings.fade_in,   &settings.variation};
            for (double* const field : fields)
                if (next() % 8 == 0)
                    *field = number();
            settings.passes = next() % 4 == 0 ? static_cast<std::uint32_t>(next()) : 0;
            settings.group = static_cast<std::uint32_t>(next() % 33);
            settings.frame = frame;
            if (next() % 32 == 0)
                settings.struct_size = static_cast<std::uint32_t>(next());
            pacini_play made = {untouched};
            if (!gaveOrSaid(pacini_play_start(engine, clip, next() % 4 == 0 ? nullptr : &settings, &made), made))
                return false;
            if (made.id == untouched)
                break;
            ++started;
            handles.add(plays, made.id);
            break;
        }
        case 5:
            pacini_play_set(play, control, x, y, frame);
            break;
        case 6:
            pacini_play_stop(play, x, frame);
            break;
        case 7:
            pacini_play_pause(play, x, frame);
            break;
        case 8:
            pacini_play_resume(play, x, frame);
            break;
        case 9:
            pacini_play_seek(play, x, frame);
            break;
        case 10:
            pacini_group_set(engine, static_cast<std::uint32_t>(next() % 34), control, x, y, frame);
            break;
        case 11:
            pacini_group_stop(engine, static_cast<std::uint32_t>(next() % 34), x, frame);
            break;
        case 12:
            pacini_engine_set_actuator_gain(engine, static_cast<std::uint32_t>(next() % 5), x, y, frame);
            pacini_engine_set_budget(engine, x, static_cast<std::uint32_t>(next() % 3), next() % 2 == 0 ? 0u : 2u);
            pacini_engine_calibrate(engine, x == 0.0 ? -0.1 : x, nullptr);
            break;
        case 13:
            if (next() % 8 == 0)
                pacini_engine_destroy(engine);
            if (next() % 8 == 0)
                pacini_clip_release(clip);
            break;
        case 14:
            pacini_clip_reload(clip, clipText.data(), clipText.size());
            break;
        case 15:
        {
            pacini_play_info ofPlay;
            pacini_play_info_init(&ofPlay);
            pacini_play_get_info(play, &ofPlay);
            pacini_engine_info ofEngine;
            pacini_engine_info_init(&ofEngine);
            pacini_engine_get_info(engine, &ofEngine);
            pacini_clip_info ofClip;
            pacini_clip_info_init(&ofClip);
            pacini_clip_get_info(clip, &ofClip);
            pacini_marker_info ofMarker;
            pacini_marker_info_init(&ofMarker);
            pacini_clip_get_marker(clip, ofClip.events, &ofMarker);
            pacini_clip_find_marker(clip, ofClip.name, ofPlay.struct_size, &ofMarker);
            pacini_clip_count_markers(clip, &ofMarker.index);
            pacini_attachment_info ofLink;
            pacini_attachment_info_init(&ofLink);
            pacini_engine_get_attachment(engine, &ofLink);
            attached += ofLink.state == PACINI_ATTACHED ? 1 : 0;
            break;
        }
        case 16:
        {
            const pacini_controller controller = {handles.of(controllers)};
            pacini_attach_settings settings;
            pacini_attach_settings_init(&settings);
            if (next() % 32 == 0)
                settings.struct_size = static_cast<std::uint32_t>(next());
            if (pacini_engine_attach(engine, controller, next() % 2 == 0 ? nullptr : &settings) != PACINI_OK)
                break;
            float sample = 1.0f;
            float* const channels[] = {&sample};
            if (pacini_render(engine, channels, 1, 1) != PACINI_BUSY || sample != 0.0f)
                return false;
            break;
        }
        case 17:
        {
            std::array<pacini_controller, 3> found{};
            std::uint32_t count = 0;
            if (next() % 8 == 0)
                pacini_controllers_find(found.data(), static_cast<std::uint32_t>(next() % 4), &count);
            for (const pacini_controller each : found)
                handles.add(controllers, each.id);
            pacini_controller_info ofController;
            pacini_controller_info_init(&ofController);
            pacini_controller_get_info({handles.of(controllers)}, &ofController);
            pacini_engine_detach(engine);
            break;
        }
        default:
            if (!rendersWell(engine))
                return false;
        }
    }
    return true;
}
} // namespace

int main(int argc, char** argv)
{
    if (argc < 2)
        return 2;
    const long long count = std::atoll(argv[1]);
    state = argc > 2 ? std::strtoull(argv[2], nullptr, 10) | 1u : 20261125u;
    Handles handles;
    for (long long i = 0; i < count; ++i)
        if (!sequence(handles))
        {
            std::printf("in sequence %lld\n", i);
            return 1;
        }
    std::printf("%lld sequences of random calls, %llu plays, up to %.2f of full drive\n", count,
                static_cast<unsigned long long>(started), strongest);
    const bool tried = started > static_cast<std::uint64_t>(count) / 20 && strongest > 0.5;
    return tried && (argc < 4 || attached > 0) ? 0 : 1;
}
