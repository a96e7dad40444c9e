// The functions and structs of pacini.h 1.5 as they are.
//
// SPDX-License-Identifier: MIT
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Pacini
{
    /// <summary>Functions of libpacini: libpacini.so, libpacini.dylib or pacini.dll.</summary>
    internal static class Native
    {
        private const string Library = "pacini";
        private const CallingConvention C = CallingConvention.Cdecl;

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_clip
        {
            public ulong id;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_texture
        {
            public ulong id;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_engine
        {
            public ulong id;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_play
        {
            public ulong id;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_controller
        {
            public ulong id;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_clip_info
        {
            public uint struct_size;
            public uint events;
            public double duration;
            public ulong bytes;
            [MarshalAs(UnmanagedType.ByValArray, SizeConst = 64)] public byte[] name;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_marker_info
        {
            public uint struct_size;
            public uint index;
            public double time;
            [MarshalAs(UnmanagedType.ByValArray, SizeConst = 128)] public byte[] name;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_actuator
        {
            public IntPtr profile;
            public double gain;
            public double delay;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_engine_config
        {
            public uint struct_size;
            public uint actuator_count;
            public double sample_rate;
            [MarshalAs(UnmanagedType.ByValArray, SizeConst = 16)] public pacini_actuator[] actuators;
            public int pan_law;
            public int protect;
            public double pan_delay;
            public double longest_delay;
            public double strength;
            public uint max_plays;
            public uint max_commands;
            public double budget;
            public uint budget_frames;
            public uint budget_voices;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_engine_info
        {
            public uint struct_size;
            public uint latency;
            public long frame;
            public uint playing;
            public uint left_out;
            public double cost;
            public double left_out_error;
            public double gain_reduction;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_play_settings
        {
            public uint struct_size;
            public uint group;
            public long frame;
            public double gain, intensity, pan, delay, transposition, speed;
            public double from;
            public double loop;
            public uint passes;
            public int priority;
            public double headroom;
            public double fade_in;
            public double variation;
            public ulong seed;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_play_info
        {
            public uint struct_size;
            public int state;
            public double position;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_controller_info
        {
            public uint struct_size;
            public int haptics;
            public int connection;
            [MarshalAs(UnmanagedType.ByValArray, SizeConst = 128)] public byte[] name;
            [MarshalAs(UnmanagedType.ByValArray, SizeConst = 256)] public byte[] path;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_attach_settings
        {
            public uint struct_size;
            public int stop_on_crash;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct pacini_attachment_info
        {
            public uint struct_size;
            public int state;
            public pacini_controller controller;
            public ulong sent;
            [MarshalAs(UnmanagedType.ByValArray, SizeConst = 128)] public byte[] failure;
        }

        [DllImport(Library, CallingConvention = C)] internal static extern uint pacini_api_version();
        [DllImport(Library, CallingConvention = C)] private static extern IntPtr pacini_result_text(int result);
        [DllImport(Library, CallingConvention = C)] private static extern UIntPtr pacini_last_error([Out] byte[] text, UIntPtr size);

        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_clip_load(byte[] bytes, UIntPtr size, out pacini_clip clip);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_clips_load(IntPtr[] bytes, UIntPtr[] sizes, UIntPtr count, [Out] pacini_clip[] clips);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_clip_load_file(byte[] path, out pacini_clip clip);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_texture_load(byte[] bytes, UIntPtr size, out pacini_texture texture);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_texture_load_file(byte[] path, out pacini_texture texture);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_texture_release(pacini_texture texture);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_clip_reload(pacini_clip clip, byte[] bytes, UIntPtr size);
        [DllImport(Library, CallingConvention = C)] internal static extern void pacini_clip_info_init(ref pacini_clip_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_clip_get_info(pacini_clip clip, ref pacini_clip_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_clip_count_markers(pacini_clip clip, out uint count);
        [DllImport(Library, CallingConvention = C)] internal static extern void pacini_marker_info_init(ref pacini_marker_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_clip_get_marker(pacini_clip clip, uint index, ref pacini_marker_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_clip_find_marker(pacini_clip clip, byte[] name, uint index, ref pacini_marker_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_clip_release(pacini_clip clip);

        [DllImport(Library, CallingConvention = C)] internal static extern void pacini_engine_config_init(ref pacini_engine_config config);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_engine_create(ref pacini_engine_config config, out pacini_engine engine);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_engine_create_scene(ref pacini_engine_config config, byte[] path, out pacini_engine engine);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_engine_destroy(pacini_engine engine);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_render_interleaved(pacini_engine engine, [Out] float[] samples, uint channel_count, uint frames);
        [DllImport(Library, CallingConvention = C)] internal static extern void pacini_engine_info_init(ref pacini_engine_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_engine_get_info(pacini_engine engine, ref pacini_engine_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_engine_set_budget(pacini_engine engine, double microseconds, uint frames, uint voices);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_engine_calibrate(pacini_engine engine, double factor, out double used);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_engine_set_actuator_gain(pacini_engine engine, uint actuator, double gain, double glide, long frame);

        [DllImport(Library, CallingConvention = C)] internal static extern void pacini_play_settings_init(ref pacini_play_settings settings);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_play_start(pacini_engine engine, pacini_clip clip, ref pacini_play_settings settings, out pacini_play play);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_texture_start(pacini_engine engine, pacini_texture texture, double speed, double force, ref pacini_play_settings settings, out pacini_play play);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_play_set(pacini_play play, int control, double value, double glide, long frame);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_play_stop(pacini_play play, double fade, long frame);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_play_pause(pacini_play play, double fade, long frame);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_play_resume(pacini_play play, double fade, long frame);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_play_seek(pacini_play play, double position, long frame);
        [DllImport(Library, CallingConvention = C)] internal static extern void pacini_play_info_init(ref pacini_play_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_play_get_info(pacini_play play, ref pacini_play_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_group_set(pacini_engine engine, uint group, int control, double value, double glide, long frame);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_group_stop(pacini_engine engine, uint group, double fade, long frame);

        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_controllers_find([Out] pacini_controller[] controllers, uint capacity, out uint count);
        [DllImport(Library, CallingConvention = C)] internal static extern void pacini_controller_info_init(ref pacini_controller_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_controller_get_info(pacini_controller controller, ref pacini_controller_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern void pacini_attach_settings_init(ref pacini_attach_settings settings);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_engine_attach(pacini_engine engine, pacini_controller controller, ref pacini_attach_settings settings);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_engine_detach(pacini_engine engine);
        [DllImport(Library, CallingConvention = C)] internal static extern void pacini_attachment_info_init(ref pacini_attachment_info info);
        [DllImport(Library, CallingConvention = C)] internal static extern int pacini_engine_get_attachment(pacini_engine engine, ref pacini_attachment_info info);

        /// <summary>UTF-8 with a 0 at the end, as the library wants texts.</summary>
        internal static byte[] Utf8(string text)
        {
            return Encoding.UTF8.GetBytes(text + "\0");
        }

        internal static string Text(byte[] utf8)
        {
            int length = Array.IndexOf(utf8, (byte)0);
            return Encoding.UTF8.GetString(utf8, 0, length < 0 ? utf8.Length : length);
        }

        /// <summary>Throws with what the library says of a call of this thread that failed.</summary>
        /// <summary>What C calls max_plays at the beginning of a message is MaxPlays here.</summary>
        private static string InPascalCase(string why)
        {
            int end = why.IndexOf(':');
            if (end < 0 || why.IndexOf('_', 0, end) < 0 || why.IndexOfAny(new[] { ' ', '.', '[', '/' }, 0, end) >= 0)
                return why;
            var name = new StringBuilder();
            foreach (string word in why.Substring(0, end).Split('_'))
                if (word.Length > 0)
                    name.Append(char.ToUpperInvariant(word[0])).Append(word.Substring(1));
            return name + why.Substring(end);
        }

        internal static void Check(int result)
        {
            if (result == 0)
                return;
            var text = new byte[(int)pacini_last_error(null, UIntPtr.Zero)];
            pacini_last_error(text, (UIntPtr)(uint)text.Length);
            string why = InPascalCase(Text(text));
            if (why.Length == 0)
                why = Marshal.PtrToStringAnsi(pacini_result_text(result));
            throw new PaciniException((Result)result, why);
        }
    }
}
