//! Prints sizes and offsets of the structs, to be compared with those of the C compiler.
use pacini::sys::*;
use std::mem::{size_of, MaybeUninit};

macro_rules! layout {
    ($name:ident: $($field:ident),*) => {
        println!("{} {}", stringify!($name), size_of::<$name>());
        let place = MaybeUninit::<$name>::uninit();
        $(
            // SAFETY: only addresses are taken.
            let offset = unsafe {
                std::ptr::addr_of!((*place.as_ptr()).$field) as usize - place.as_ptr() as usize
            };
            println!("{}.{} {}", stringify!($name), stringify!($field).trim_start_matches("r#"), offset);
        )*
    };
}

#[test]
fn layout() {
    layout!(pacini_clip: id);
    layout!(pacini_texture: id);
    layout!(pacini_engine: id);
    layout!(pacini_play: id);
    layout!(pacini_controller: id);
    layout!(pacini_clip_info: struct_size, events, duration, bytes, name);
    layout!(pacini_marker_info: struct_size, index, time, name);
    layout!(pacini_actuator: profile, gain, delay);
    layout!(pacini_engine_config: struct_size, actuator_count, sample_rate, actuators, pan_law, protect, pan_delay,
        longest_delay, strength, max_plays, max_commands, budget, budget_frames, budget_voices);
    layout!(pacini_engine_info: struct_size, latency, frame, playing, left_out, cost, left_out_error, gain_reduction);
    layout!(pacini_play_settings: struct_size, group, frame, gain, intensity, pan, delay, transposition, speed, from,
        r#loop, passes, priority, headroom, fade_in, variation, seed);
    layout!(pacini_play_info: struct_size, state, position);
    layout!(pacini_controller_info: struct_size, haptics, connection, name, path);
    layout!(pacini_attach_settings: struct_size, stop_on_crash);
    layout!(pacini_attachment_info: struct_size, state, controller, sent, failure);
}
