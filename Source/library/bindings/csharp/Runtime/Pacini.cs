// Pacini's runtime for C#: haptic clips that play at once on several actuators. Needs neither Unity nor unsafe code.
//
// Engine.Render is for the audio thread, one at a time for each engine; it neither allocates nor waits. Everything else may
// be called from any other thread. What fails throws a PaciniException with the reason in words.
//
// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Pacini
{
    /// <summary>Why a call failed.</summary>
    public enum Result
    {
        Ok = 0,
        Invalid = 1,
        Stale = 2,
        BadData = 3,
        Newer = 4,
        TooMany = 5,
        Io = 6,
        NoMemory = 7,
        Internal = 8,
        Busy = 9
    }

    public enum PanLaw
    {
        Power = 0,
        Delay = 1,
        Both = 2
    }

    /// <summary>What can be changed while a clip plays; pacini.h has the ranges.</summary>
    public enum Control
    {
        Gain = 0,
        Intensity = 1,
        Pan = 2,
        Delay = 3,
        Transposition = 4,
        Speed = 5,
        Priority = 6,
        Tones = 7,
        Events = 8,
        Noise = 9,
        TextureSpeed = 10,
        TextureForce = 11
    }

    public enum PlayState
    {
        Ended = 0,
        Waiting = 1,
        Playing = 2,
        Paused = 3,
        LeftOut = 4
    }

    public sealed class PaciniException : Exception
    {
        public Result Result { get; private set; }

        internal PaciniException(Result result, string message) : base(message)
        {
            Result = result;
        }
    }

    public static class Library
    {
        /// <summary>Version of the interface of the loaded library: major * 1000 + minor.</summary>
        public static int Version { get { return (int)Native.pacini_api_version(); } }

        /// <summary>Throws when this binding is not for it.</summary>
        internal static void Check()
        {
            if (Version < 1005 || Version >= 2000)
                throw new PaciniException(Result.Newer, "libpacini has the interface " + Version / 1000.0 + ", this binding is for 1.5 or a newer 1.x");
        }
    }

    /// <summary>What a controller understands.</summary>
    public enum Haptics
    {
        HdRumble = 0,
        DualShock4 = 1,
        DualSense = 2,
        Xbox = 3,
        Waveforms = 4,
        SteamController = 5,
        SteamDeck = 6
    }

    public enum Connection
    {
        Unknown = 0,
        Usb = 1,
        Bluetooth = 2,
        Receiver = 3
    }

    public enum AttachmentState
    {
        Detached = 0,
        Attached = 1,
        /// <summary>Unplugged or switched off: the engine goes on unfelt until it is detached.</summary>
        Gone = 2
    }

    public struct Attachment
    {
        public AttachmentState State;
        /// <summary>Reports so far.</summary>
        public long Sent;
        /// <summary>Why it is gone.</summary>
        public string Failure;
    }

    /// <summary>A game controller, or another haptic device.</summary>
    public sealed class Controller
    {
        internal readonly Native.pacini_controller Handle;
        public readonly string Name, Path;
        public readonly Haptics Haptics;
        public readonly Connection Connection;

        private Controller(Native.pacini_controller handle)
        {
            Handle = handle;
            var info = new Native.pacini_controller_info();
            Native.pacini_controller_info_init(ref info);
            Native.Check(Native.pacini_controller_get_info(handle, ref info));
            Name = Native.Text(info.name);
            Path = Native.Text(info.path);
            Haptics = (Haptics)info.haptics;
            Connection = (Connection)info.connection;
        }

        /// <summary>What is connected. Takes up to 0.1 s.</summary>
        public static List<Controller> Find()
        {
            Library.Check();
            var handles = new Native.pacini_controller[32];
            uint count;
            Native.Check(Native.pacini_controllers_find(handles, (uint)handles.Length, out count));
            var found = new List<Controller>();
            for (int i = 0; i < Math.Min(count, handles.Length); ++i)
                found.Add(new Controller(handles[i]));
            return found;
        }
    }

    /// <summary>A named point of time of a clip.</summary>
    public struct Marker
    {
        /// <summary>From 0, in order of time.</summary>
        public int Index;
        /// <summary>In seconds of the clip.</summary>
        public double Time;
        /// <summary>At most 127 bytes of UTF-8; cut if it is longer.</summary>
        public string Name;
    }

    /// <summary>A haptic clip in memory. It can play as often as one likes, on any engine.</summary>
    public sealed class Clip : IDisposable
    {
        internal Native.pacini_clip Handle { get; private set; }

        private Clip(Native.pacini_clip handle)
        {
            Handle = handle;
        }

        /// <summary>From a file of any format that Pacini reads.</summary>
        public static Clip Load(string path)
        {
            Native.pacini_clip handle;
            Native.Check(Native.pacini_clip_load_file(Native.Utf8(path), out handle));
            return new Clip(handle);
        }

        /// <summary>From the bytes of such a file.</summary>
        public static Clip FromBytes(byte[] bytes)
        {
            Native.pacini_clip handle;
            Native.Check(Native.pacini_clip_load(bytes, (UIntPtr)(uint)bytes.Length, out handle));
            return new Clip(handle);
        }

        /// <summary>Of the bytes of several such files: all, or an exception about the first that is none.</summary>
        public static Clip[] AllFromBytes(params byte[][] all)
        {
            var pinned = new GCHandle[all.Length];
            try
            {
                var bytes = new IntPtr[all.Length];
                var sizes = new UIntPtr[all.Length];
                for (int i = 0; i < all.Length; i++)
                {
                    pinned[i] = GCHandle.Alloc(all[i], GCHandleType.Pinned);
                    bytes[i] = pinned[i].AddrOfPinnedObject();
                    sizes[i] = (UIntPtr)(uint)all[i].Length;
                }
                var handles = new Native.pacini_clip[all.Length];
                Native.Check(Native.pacini_clips_load(bytes, sizes, (UIntPtr)(uint)all.Length, handles));
                return Array.ConvertAll(handles, handle => new Clip(handle));
            }
            finally
            {
                foreach (GCHandle one in pinned)
                    if (one.IsAllocated)
                        one.Free();
            }
        }

        /// <summary>Puts other content in its place; what plays of it fades over.</summary>
        public void Reload(byte[] bytes)
        {
            Native.Check(Native.pacini_clip_reload(Handle, bytes, (UIntPtr)(uint)bytes.Length));
        }

        private Native.pacini_clip_info Info
        {
            get
            {
                var info = new Native.pacini_clip_info();
                Native.pacini_clip_info_init(ref info);
                Native.Check(Native.pacini_clip_get_info(Handle, ref info));
                return info;
            }
        }

        /// <summary>At most 63 bytes of UTF-8; cut if it is longer.</summary>
        public string Name { get { return Native.Text(Info.name); } }

        /// <summary>In seconds.</summary>
        public double Duration { get { return Info.duration; } }

        /// <summary>Transients.</summary>
        public int Events { get { return (int)Info.events; } }

        /// <summary>Memory that it takes.</summary>
        public long Bytes { get { return (long)Info.bytes; } }

        /// <summary>In order of time. A loop of a WAV is two of them, "loop start" and "loop end".</summary>
        public Marker[] Markers
        {
            get
            {
                uint count;
                Native.Check(Native.pacini_clip_count_markers(Handle, out count));
                var found = new Marker[count];
                for (uint i = 0; i < count; ++i)
                {
                    uint index = i;
                    found[i] = GetMarker((ref Native.pacini_marker_info info) => Native.pacini_clip_get_marker(Handle, index, ref info));
                }
                return found;
            }
        }

        /// <summary>The first marker with this name, from the marker `index` on.</summary>
        public Marker FindMarker(string name, int index = 0)
        {
            byte[] utf8 = Native.Utf8(name);
            return GetMarker((ref Native.pacini_marker_info info) =>
                Native.pacini_clip_find_marker(Handle, utf8, (uint)Math.Max(0, index), ref info));
        }

        private delegate int GetInfo(ref Native.pacini_marker_info info);

        private static Marker GetMarker(GetInfo get)
        {
            var info = new Native.pacini_marker_info();
            Native.pacini_marker_info_init(ref info);
            Native.Check(get(ref info));
            return new Marker { Index = (int)info.index, Time = info.time, Name = Native.Text(info.name) };
        }

        /// <summary>Releases it; what plays of it goes on to its end.</summary>
        public void Dispose()
        {
            if (Handle.id != 0)
                Native.pacini_clip_release(Handle);
            Handle = new Native.pacini_clip();
            GC.SuppressFinalize(this);
        }

        ~Clip()
        {
            if (Handle.id != 0)
                Native.pacini_clip_release(Handle);
        }
    }

    /// <summary>What a hand feels of a surface: made of a recording by `pacini texture analyse`, played by speed and
    /// force.</summary>
    public sealed class HapticTexture : IDisposable
    {
        internal Native.pacini_texture Handle { get; private set; }

        private HapticTexture(Native.pacini_texture handle)
        {
            Handle = handle;
        }

        /// <summary>From a file.</summary>
        public static HapticTexture Load(string path)
        {
            Native.pacini_texture handle;
            Native.Check(Native.pacini_texture_load_file(Native.Utf8(path), out handle));
            return new HapticTexture(handle);
        }

        /// <summary>From the bytes of such a file.</summary>
        public static HapticTexture FromBytes(byte[] bytes)
        {
            Native.pacini_texture handle;
            Native.Check(Native.pacini_texture_load(bytes, (UIntPtr)(uint)bytes.Length, out handle));
            return new HapticTexture(handle);
        }

        /// <summary>Releases it; what plays of it goes on.</summary>
        public void Dispose()
        {
            if (Handle.id != 0)
                Native.pacini_texture_release(Handle);
            Handle = new Native.pacini_texture();
            GC.SuppressFinalize(this);
        }

        ~HapticTexture()
        {
            if (Handle.id != 0)
                Native.pacini_texture_release(Handle);
        }
    }

    /// <summary>One of the actuators of an engine.</summary>
    public sealed class Actuator
    {
        /// <summary>Name of a profile that comes with Pacini, or the text of one in JSON; null: the drive signal as it is.</summary>
        public string Profile;
        public double Gain = 1.0;
        /// <summary>In seconds.</summary>
        public double Delay;

        public Actuator(string profile = null)
        {
            Profile = profile;
        }
    }

    /// <summary>What an engine is made for; the defaults are the library's.</summary>
    public sealed class EngineConfig
    {
        /// <summary>1 to 16, in a row from pan 0 to pan 1; none: one without a profile.</summary>
        public readonly List<Actuator> Actuators = new List<Actuator>();
        public double SampleRate;
        public PanLaw PanLaw;
        public bool Protect;
        public double PanDelay, LongestDelay, Strength;
        public int MaxPlays, MaxCommands;
        /// <summary>Microseconds for a block of BudgetFrames; 0: all.</summary>
        public double Budget;
        public int BudgetFrames, BudgetVoices;

        public EngineConfig(params string[] profiles)
        {
            var usual = Usual();
            SampleRate = usual.sample_rate;
            PanLaw = (PanLaw)usual.pan_law;
            Protect = usual.protect != 0;
            PanDelay = usual.pan_delay;
            LongestDelay = usual.longest_delay;
            Strength = usual.strength;
            MaxPlays = (int)usual.max_plays;
            MaxCommands = (int)usual.max_commands;
            Budget = usual.budget;
            BudgetFrames = (int)usual.budget_frames;
            BudgetVoices = (int)usual.budget_voices;
            foreach (string profile in profiles)
                Actuators.Add(new Actuator(profile));
        }

        private static Native.pacini_engine_config Usual()
        {
            Library.Check(); // before any struct is written
            var usual = new Native.pacini_engine_config { actuators = new Native.pacini_actuator[16] };
            Native.pacini_engine_config_init(ref usual);
            return usual;
        }

        internal Native.pacini_engine Create(string scene)
        {
            var config = Usual();
            config.sample_rate = SampleRate;
            config.pan_law = (int)PanLaw;
            config.protect = Protect ? 1 : 0;
            config.pan_delay = PanDelay;
            config.longest_delay = LongestDelay;
            config.strength = Strength;
            config.max_plays = Unsigned(MaxPlays);
            config.max_commands = Unsigned(MaxCommands);
            config.budget = Budget;
            config.budget_frames = Unsigned(BudgetFrames);
            config.budget_voices = Unsigned(BudgetVoices);
            config.actuator_count = (uint)Math.Max(1, Actuators.Count);
            int count = Math.Min(Actuators.Count, config.actuators.Length);
            try
            {
                for (int i = 0; i < count; ++i)
                {
                    config.actuators[i].gain = Actuators[i].Gain;
                    config.actuators[i].delay = Actuators[i].Delay;
                    if (Actuators[i].Profile == null)
                        continue;
                    byte[] text = Native.Utf8(Actuators[i].Profile);
                    config.actuators[i].profile = Marshal.AllocHGlobal(text.Length);
                    Marshal.Copy(text, 0, config.actuators[i].profile, text.Length);
                }
                Native.pacini_engine handle;
                Native.Check(scene == null ? Native.pacini_engine_create(ref config, out handle)
                                           : Native.pacini_engine_create_scene(ref config, Native.Utf8(scene), out handle));
                return handle;
            }
            finally
            {
                foreach (var actuator in config.actuators)
                    if (actuator.profile != IntPtr.Zero)
                        Marshal.FreeHGlobal(actuator.profile);
            }
        }

        private static uint Unsigned(int number)
        {
            return (uint)Math.Max(0, number); // the library tells what is too little
        }
    }

    /// <summary>How a clip is played; the defaults are the library's: once, now, in the middle, as it is.</summary>
    public sealed class PlaySettings
    {
        public int Group, Priority, Passes;
        public long Frame;
        public double Gain, Intensity, Pan, Delay, Transposition, Speed, From, Headroom, FadeIn, Variation;
        /// <summary>Seconds of the clip that are repeated; 0: play once; -1: the whole clip.</summary>
        public double Loop;
        public ulong Seed;

        public PlaySettings()
        {
            var usual = Usual();
            Gain = usual.gain;
            Intensity = usual.intensity;
            Pan = usual.pan;
            Speed = usual.speed;
        }

        internal static Native.pacini_play_settings Usual()
        {
            var usual = new Native.pacini_play_settings();
            Native.pacini_play_settings_init(ref usual);
            return usual;
        }

        internal Native.pacini_play_settings Struct()
        {
            var settings = Usual();
            settings.group = (uint)Group;
            settings.frame = Frame;
            settings.gain = Gain;
            settings.intensity = Intensity;
            settings.pan = Pan;
            settings.delay = Delay;
            settings.transposition = Transposition;
            settings.speed = Speed;
            settings.from = From;
            settings.loop = Loop;
            settings.passes = (uint)Math.Max(0, Passes);
            settings.priority = Priority;
            settings.headroom = Headroom;
            settings.fade_in = FadeIn;
            settings.variation = Variation;
            settings.seed = Seed;
            return settings;
        }
    }

    public struct EngineInfo
    {
        /// <summary>Frames that a command must come ahead to be exact.</summary>
        public int Latency;
        /// <summary>Frames rendered so far.</summary>
        public long Frame;
        public int Playing, LeftOut;
        /// <summary>Microseconds that a block is predicted to take.</summary>
        public double Cost;
        /// <summary>In dB.</summary>
        public double LeftOutError, GainReduction;
    }

    /// <summary>Plays clips on up to 16 actuators.</summary>
    public sealed class Engine : IDisposable
    {
        private Native.pacini_engine handle;

        public Engine(params string[] profiles) : this(new EngineConfig(profiles), null)
        {
        }

        /// <summary>With a scene, the path of a file, it plays that by itself from frame 0 on.</summary>
        public Engine(EngineConfig config, string scene = null)
        {
            handle = config.Create(scene);
        }

        /// <summary>Starts a clip; null: as `new PlaySettings()`.</summary>
        public Play Play(Clip clip, PlaySettings settings = null)
        {
            var given = settings == null ? PlaySettings.Usual() : settings.Struct();
            Native.pacini_play play;
            Native.Check(Native.pacini_play_start(handle, clip.Handle, ref given, out play));
            GC.KeepAlive(clip);
            return new Play(play);
        }

        /// <summary>Starts a texture, which plays until it is stopped; set Control.TextureSpeed and Control.TextureForce
        /// (0 to 1) while it does.</summary>
        public Play Play(HapticTexture texture, double speed, double force = 1.0, PlaySettings settings = null)
        {
            var given = settings == null ? PlaySettings.Usual() : settings.Struct();
            Native.pacini_play play;
            Native.Check(Native.pacini_texture_start(handle, texture.Handle, speed, force, ref given, out play));
            GC.KeepAlive(texture);
            return new Play(play);
        }

        /// <summary>The next frames, frame by frame: samples[frame * channels + actuator]. Channels beyond the actuators
        /// are silent. As many frames as fit, or fewer. For the audio thread. False when the engine is disposed or
        /// plays on a controller: all is silent then.</summary>
        public bool Render(float[] samples, int channels, int frames = int.MaxValue)
        {
            if (channels < 1 || frames < 1)
                return true;
            frames = Math.Min(frames, samples.Length / channels);
            return Native.pacini_render_interleaved(handle, samples, (uint)channels, (uint)frames) == 0;
        }

        public EngineInfo Info
        {
            get
            {
                var info = new Native.pacini_engine_info();
                Native.pacini_engine_info_init(ref info);
                Native.Check(Native.pacini_engine_get_info(handle, ref info));
                return new EngineInfo
                {
                    Latency = (int)info.latency,
                    Frame = info.frame,
                    Playing = (int)info.playing,
                    LeftOut = (int)info.left_out,
                    Cost = info.cost,
                    LeftOutError = info.left_out_error,
                    GainReduction = info.gain_reduction
                };
            }
        }

        /// <summary>What may play at a time: microseconds for a block of so many frames, and voices; 0: all.</summary>
        public void SetBudget(double microseconds, int frames = 512, int voices = 0)
        {
            Native.Check(Native.pacini_engine_set_budget(handle, microseconds, (uint)Math.Max(0, frames), (uint)Math.Max(0, voices)));
        }

        /// <summary>How many times as long as predicted blocks take on this machine; 0 measures it of the last ones. Returns it.</summary>
        public double Calibrate(double factor = 0.0)
        {
            Native.Check(Native.pacini_engine_calibrate(handle, factor, out double used));
            return used;
        }

        /// <summary>Gain of an actuator, the first is 0, behind its protection.</summary>
        public void SetActuatorGain(int actuator, double gain, double glide = 0.0, long frame = 0)
        {
            Native.Check(Native.pacini_engine_set_actuator_gain(handle, (uint)actuator, gain, glide, frame));
        }

        /// <summary>A control of all plays of a group, 0 to 31.</summary>
        public void SetGroup(int group, Control control, double value, double glide = 0.0, long frame = 0)
        {
            Native.Check(Native.pacini_group_set(handle, (uint)group, (int)control, value, glide, frame));
        }

        public void StopGroup(int group, double fade = 0.0, long frame = 0)
        {
            Native.Check(Native.pacini_group_stop(handle, (uint)group, fade, frame));
        }

        /// <summary>Plays on a controller from now on, on a thread of the library; Render is false and silent meanwhile.
        /// `stopOnCrash` silences it when the program crashes, by handlers of signals.</summary>
        public void Attach(Controller controller, bool stopOnCrash = false)
        {
            var settings = new Native.pacini_attach_settings();
            Native.pacini_attach_settings_init(ref settings);
            settings.stop_on_crash = stopOnCrash ? 1 : 0;
            Native.Check(Native.pacini_engine_attach(handle, controller.Handle, ref settings));
        }

        /// <summary>Silences the controller and gives the engine back to Render.</summary>
        public void Detach()
        {
            Native.Check(Native.pacini_engine_detach(handle));
        }

        public Attachment Attachment
        {
            get
            {
                var info = new Native.pacini_attachment_info();
                Native.pacini_attachment_info_init(ref info);
                Native.Check(Native.pacini_engine_get_attachment(handle, ref info));
                return new Attachment { State = (AttachmentState)info.state, Sent = (long)info.sent, Failure = Native.Text(info.failure) };
            }
        }

        /// <summary>Ends it and all its plays; waits for a block that is being rendered.</summary>
        public void Dispose()
        {
            if (handle.id != 0)
                Native.pacini_engine_destroy(handle);
            handle = new Native.pacini_engine();
            GC.SuppressFinalize(this);
        }

        ~Engine()
        {
            if (handle.id != 0)
                Native.pacini_engine_destroy(handle);
        }
    }

    /// <summary>A clip that plays. One that has ended throws, with Result.Stale, at Set, Stop, Pause, Resume and Seek.</summary>
    public sealed class Play : IDisposable
    {
        private readonly Native.pacini_play handle;

        internal Play(Native.pacini_play handle)
        {
            this.handle = handle;
        }

        /// <summary>Glides (s) in a straight line, from a frame on.</summary>
        public void Set(Control control, double value, double glide = 0.0, long frame = 0)
        {
            Native.Check(Native.pacini_play_set(handle, (int)control, value, glide, frame));
        }

        /// <summary>Fades (s) out and ends.</summary>
        public void Stop(double fade = 0.0, long frame = 0)
        {
            Native.Check(Native.pacini_play_stop(handle, fade, frame));
        }

        /// <summary>Fades (s) out and waits where it is.</summary>
        public void Pause(double fade = 0.0, long frame = 0)
        {
            Native.Check(Native.pacini_play_pause(handle, fade, frame));
        }

        public void Resume(double fade = 0.0, long frame = 0)
        {
            Native.Check(Native.pacini_play_resume(handle, fade, frame));
        }

        /// <summary>Goes on at another second of the clip.</summary>
        public void Seek(double position, long frame = 0)
        {
            Native.Check(Native.pacini_play_seek(handle, position, frame));
        }

        private int GetInfo(out Native.pacini_play_info info)
        {
            info = new Native.pacini_play_info();
            Native.pacini_play_info_init(ref info);
            return Native.pacini_play_get_info(handle, ref info);
        }

        /// <summary>Ended, too, when the engine is disposed.</summary>
        public PlayState State
        {
            get
            {
                Native.pacini_play_info info;
                int result = GetInfo(out info);
                if (result == (int)Result.Stale)
                    return PlayState.Ended;
                Native.Check(result);
                return (PlayState)info.state;
            }
        }

        /// <summary>Seconds of the clip.</summary>
        public double Position
        {
            get
            {
                Native.pacini_play_info info;
                Native.Check(GetInfo(out info));
                return info.position;
            }
        }

        /// <summary>Stops it, if it still plays.</summary>
        public void Dispose()
        {
            Native.pacini_play_stop(handle, 0.0, 0);
        }
    }
}
