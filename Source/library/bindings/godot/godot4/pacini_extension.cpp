// Haptic clips in Godot 4: a GDExtension with godot-cpp 4.2 or newer. NOT TRIED: written after its headers, but never
// compiled nor run, as no package brings godot-cpp and Godot 4. The addon for Godot 3 is the tried one.
//
//     var engine = PaciniEngine.new()
//     engine.open(["lra-175"], AudioServer.get_mix_rate())
//     var play = engine.play(PaciniClip.load_file("res://knock.pacb"), {"loop": -1.0})
//     engine.play_set(play, PaciniEngine.GAIN, 0.5, 0.1, 0)
//     playback.push_buffer(engine.render_stereo(playback.get_frames_available()))
//
// SPDX-License-Identifier: MIT

#include <godot_cpp/classes/file_access.hpp>
#include <godot_cpp/classes/ref_counted.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/godot.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <godot_cpp/variant/packed_byte_array.hpp>
#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/packed_vector2_array.hpp>
#include <pacini.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace godot;

namespace
{
/// Tells why a call failed in the debugger; whether it did not.
bool succeeded(pacini_result result)
{
    if (result == PACINI_OK)
        return true;
    std::array<char, 512> text{};
    pacini_last_error(text.data(), text.size());
    ERR_PRINT(String("pacini: ") + String::utf8(text.data()));
    return false;
}
} // namespace

/// A clip of any format that Pacini reads.
class PaciniClip : public RefCounted
{
    GDCLASS(PaciniClip, RefCounted)

public:
    ~PaciniClip() override
    {
        if (handle.id != 0)
            pacini_clip_release(handle);
    }

    /// Null when it cannot be read.
    static Ref<PaciniClip> load_file(const String& path) { return from_bytes(FileAccess::get_file_as_bytes(path)); }

    static Ref<PaciniClip> from_bytes(const PackedByteArray& bytes)
    {
        Ref<PaciniClip> clip;
        clip.instantiate();
        if (!succeeded(pacini_clip_load(bytes.ptr(), static_cast<std::size_t>(bytes.size()), &clip->handle)))
            clip.unref();
        return clip;
    }

    pacini_clip handle = PACINI_NONE;

protected:
    static void _bind_methods()
    {
        ClassDB::bind_static_method("PaciniClip", D_METHOD("load_file", "path"), &PaciniClip::load_file);
        ClassDB::bind_static_method("PaciniClip", D_METHOD("from_bytes", "bytes"), &PaciniClip::from_bytes);
    }
};

/// Plays clips on up to 16 actuators; plays are numbers, 0 for none.
class PaciniEngine : public RefCounted
{
    GDCLASS(PaciniEngine, RefCounted)

public:
    enum Control
    {
        GAIN = PACINI_GAIN,
        INTENSITY = PACINI_INTENSITY,
        PAN = PACINI_PAN,
        DELAY = PACINI_DELAY,
        TRANSPOSITION = PACINI_TRANSPOSITION,
        SPEED = PACINI_SPEED,
        PRIORITY = PACINI_PRIORITY,
        TONES = PACINI_TONES,
        EVENTS = PACINI_EVENTS,
        NOISE = PACINI_NOISE
    };

    ~PaciniEngine() override { close(); }

    /// A profile for each actuator, empty for the drive signal as it is. When it fails, what was open stays.
    bool open(const PackedStringArray& profiles, double sample_rate)
    {
        pacini_engine_config config;
        pacini_engine_config_init(&config);
        config.sample_rate = sample_rate;
        config.actuator_count = static_cast<std::uint32_t>(profiles.size());
        std::vector<CharString> texts;
        for (std::int64_t i = 0; i < profiles.size() && i < PACINI_MAX_ACTUATORS; ++i)
            texts.push_back(profiles[i].utf8());
        for (std::size_t i = 0; i < texts.size(); ++i)
            config.actuators[i].profile = texts[i].get_data();
        pacini_engine made = PACINI_NONE;
        if (!succeeded(pacini_engine_create(&config, &made)))
            return false;
        close();
        handle = made;
        return true;
    }

    void close()
    {
        if (handle.id != 0)
            pacini_engine_destroy(handle);
        handle = PACINI_NONE;
    }

    /// `settings` may have gain, intensity, pan, loop, priority and group.
    std::int64_t play(const Ref<PaciniClip>& clip, const Dictionary& settings)
    {
        ERR_FAIL_COND_V(clip.is_null(), 0);
        pacini_play_settings wanted;
        pacini_play_settings_init(&wanted);
        wanted.gain = settings.get("gain", wanted.gain);
        wanted.intensity = settings.get("intensity", wanted.intensity);
        wanted.pan = settings.get("pan", wanted.pan);
        wanted.loop = settings.get("loop", wanted.loop);
        wanted.priority = settings.get("priority", wanted.priority);
        wanted.group = settings.get("group", wanted.group);
        pacini_play started = PACINI_NONE;
        succeeded(pacini_play_start(handle, clip->handle, &wanted, &started));
        return static_cast<std::int64_t>(started.id);
    }

    bool play_set(std::int64_t play, Control control, double value, double glide, std::int64_t frame)
    {
        return succeeded(pacini_play_set({static_cast<std::uint64_t>(play)}, control, value, glide, frame));
    }

    bool play_stop(std::int64_t play, double fade, std::int64_t frame)
    {
        return succeeded(pacini_play_stop({static_cast<std::uint64_t>(play)}, fade, frame));
    }

    /// The first two actuators, as AudioStreamGeneratorPlayback.push_buffer() takes them.
    PackedVector2Array render_stereo(std::int64_t frames)
    {
        PackedVector2Array samples;
        ERR_FAIL_COND_V(frames < 0 || frames > 0x1000000, samples);
        std::vector<float> block(2 * static_cast<std::size_t>(frames));
        pacini_render_interleaved(handle, block.data(), 2, static_cast<std::uint32_t>(frames));
        samples.resize(frames);
        for (std::size_t i = 0; i < static_cast<std::size_t>(frames); ++i)
            samples[static_cast<std::int64_t>(i)] = Vector2(block[2 * i], block[2 * i + 1]);
        return samples;
    }

protected:
    static void _bind_methods()
    {
        ClassDB::bind_method(D_METHOD("open", "profiles", "sample_rate"), &PaciniEngine::open);
        ClassDB::bind_method(D_METHOD("close"), &PaciniEngine::close);
        ClassDB::bind_method(D_METHOD("play", "clip", "settings"), &PaciniEngine::play, DEFVAL(Dictionary()));
        ClassDB::bind_method(D_METHOD("play_set", "play", "control", "value", "glide", "frame"),
                             &PaciniEngine::play_set, DEFVAL(0.0), DEFVAL(0));
        ClassDB::bind_method(D_METHOD("play_stop", "play", "fade", "frame"), &PaciniEngine::play_stop, DEFVAL(0.0),
                             DEFVAL(0));
        ClassDB::bind_method(D_METHOD("render_stereo", "frames"), &PaciniEngine::render_stereo);
        BIND_ENUM_CONSTANT(GAIN);
        BIND_ENUM_CONSTANT(INTENSITY);
        BIND_ENUM_CONSTANT(PAN);
        BIND_ENUM_CONSTANT(DELAY);
        BIND_ENUM_CONSTANT(TRANSPOSITION);
        BIND_ENUM_CONSTANT(SPEED);
        BIND_ENUM_CONSTANT(PRIORITY);
        BIND_ENUM_CONSTANT(TONES);
        BIND_ENUM_CONSTANT(EVENTS);
        BIND_ENUM_CONSTANT(NOISE);
    }

private:
    pacini_engine handle = PACINI_NONE;
};

VARIANT_ENUM_CAST(PaciniEngine::Control);

namespace
{
void initialize(ModuleInitializationLevel level)
{
    if (level != MODULE_INITIALIZATION_LEVEL_SCENE)
        return;
    ClassDB::register_class<PaciniClip>();
    ClassDB::register_class<PaciniEngine>();
}

void terminate(ModuleInitializationLevel) {}
} // namespace

extern "C" GDExtensionBool GDE_EXPORT pacini_extension_init(GDExtensionInterfaceGetProcAddress get_proc_address,
                                                            GDExtensionClassLibraryPtr library,
                                                            GDExtensionInitialization* initialization)
{
    const GDExtensionBinding::InitObject init(get_proc_address, library, initialization);
    init.register_initializer(initialize);
    init.register_terminator(terminate);
    init.set_minimum_library_initialization_level(MODULE_INITIALIZATION_LEVEL_SCENE);
    return init.init();
}
