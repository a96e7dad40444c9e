//! The functions and structs of pacini.h 1.5 as they are.
#![allow(non_camel_case_types, missing_docs)]

use std::os::raw::{c_char, c_int, c_void};

pub type pacini_result = c_int;

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct pacini_clip {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct pacini_texture {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct pacini_engine {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct pacini_play {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct pacini_controller {
    pub id: u64,
}

#[repr(C)]
pub struct pacini_clip_info {
    pub struct_size: u32,
    pub events: u32,
    pub duration: f64,
    pub bytes: u64,
    pub name: [c_char; 64],
}

#[repr(C)]
pub struct pacini_marker_info {
    pub struct_size: u32,
    pub index: u32,
    pub time: f64,
    pub name: [c_char; 128],
}

#[repr(C)]
pub struct pacini_actuator {
    pub profile: *const c_char,
    pub gain: f64,
    pub delay: f64,
}

#[repr(C)]
pub struct pacini_engine_config {
    pub struct_size: u32,
    pub actuator_count: u32,
    pub sample_rate: f64,
    pub actuators: [pacini_actuator; 16],
    pub pan_law: i32,
    pub protect: i32,
    pub pan_delay: f64,
    pub longest_delay: f64,
    pub strength: f64,
    pub max_plays: u32,
    pub max_commands: u32,
    pub budget: f64,
    pub budget_frames: u32,
    pub budget_voices: u32,
}

#[repr(C)]
pub struct pacini_engine_info {
    pub struct_size: u32,
    pub latency: u32,
    pub frame: i64,
    pub playing: u32,
    pub left_out: u32,
    pub cost: f64,
    pub left_out_error: f64,
    pub gain_reduction: f64,
}

#[repr(C)]
pub struct pacini_play_settings {
    pub struct_size: u32,
    pub group: u32,
    pub frame: i64,
    pub gain: f64,
    pub intensity: f64,
    pub pan: f64,
    pub delay: f64,
    pub transposition: f64,
    pub speed: f64,
    pub from: f64,
    pub r#loop: f64,
    pub passes: u32,
    pub priority: i32,
    pub headroom: f64,
    pub fade_in: f64,
    pub variation: f64,
    pub seed: u64,
}

#[repr(C)]
pub struct pacini_play_info {
    pub struct_size: u32,
    pub state: i32,
    pub position: f64,
}

#[repr(C)]
pub struct pacini_controller_info {
    pub struct_size: u32,
    pub haptics: i32,
    pub connection: i32,
    pub name: [c_char; 128],
    pub path: [c_char; 256],
}

#[repr(C)]
pub struct pacini_attach_settings {
    pub struct_size: u32,
    pub stop_on_crash: i32,
}

#[repr(C)]
pub struct pacini_attachment_info {
    pub struct_size: u32,
    pub state: i32,
    pub controller: pacini_controller,
    pub sent: u64,
    pub failure: [c_char; 128],
}

extern "C" {
    pub fn pacini_api_version() -> u32;
    pub fn pacini_result_text(result: pacini_result) -> *const c_char;
    pub fn pacini_last_error(text: *mut c_char, size: usize) -> usize;

    pub fn pacini_clip_load(bytes: *const c_void, size: usize, clip: *mut pacini_clip) -> pacini_result;
    pub fn pacini_clips_load(
        bytes: *const *const c_void,
        sizes: *const usize,
        count: usize,
        clips: *mut pacini_clip,
    ) -> pacini_result;
    pub fn pacini_clip_load_file(path: *const c_char, clip: *mut pacini_clip) -> pacini_result;
    pub fn pacini_texture_load(bytes: *const c_void, size: usize, texture: *mut pacini_texture) -> pacini_result;
    pub fn pacini_texture_load_file(path: *const c_char, texture: *mut pacini_texture) -> pacini_result;
    pub fn pacini_texture_release(texture: pacini_texture) -> pacini_result;
    pub fn pacini_clip_reload(clip: pacini_clip, bytes: *const c_void, size: usize) -> pacini_result;
    pub fn pacini_clip_info_init(info: *mut pacini_clip_info);
    pub fn pacini_clip_get_info(clip: pacini_clip, info: *mut pacini_clip_info) -> pacini_result;
    pub fn pacini_clip_count_markers(clip: pacini_clip, count: *mut u32) -> pacini_result;
    pub fn pacini_marker_info_init(info: *mut pacini_marker_info);
    pub fn pacini_clip_get_marker(clip: pacini_clip, index: u32, info: *mut pacini_marker_info) -> pacini_result;
    pub fn pacini_clip_find_marker(
        clip: pacini_clip,
        name: *const c_char,
        index: u32,
        info: *mut pacini_marker_info,
    ) -> pacini_result;
    pub fn pacini_clip_release(clip: pacini_clip) -> pacini_result;

    pub fn pacini_engine_config_init(config: *mut pacini_engine_config);
    pub fn pacini_engine_create(config: *const pacini_engine_config, engine: *mut pacini_engine) -> pacini_result;
    pub fn pacini_engine_create_scene(
        config: *const pacini_engine_config,
        scene_path: *const c_char,
        engine: *mut pacini_engine,
    ) -> pacini_result;
    pub fn pacini_engine_destroy(engine: pacini_engine) -> pacini_result;
    pub fn pacini_render(
        engine: pacini_engine,
        channels: *const *mut f32,
        channel_count: u32,
        frames: u32,
    ) -> pacini_result;
    pub fn pacini_render_interleaved(
        engine: pacini_engine,
        samples: *mut f32,
        channel_count: u32,
        frames: u32,
    ) -> pacini_result;
    pub fn pacini_engine_info_init(info: *mut pacini_engine_info);
    pub fn pacini_engine_get_info(engine: pacini_engine, info: *mut pacini_engine_info) -> pacini_result;
    pub fn pacini_engine_set_budget(
        engine: pacini_engine,
        microseconds: f64,
        frames: u32,
        voices: u32,
    ) -> pacini_result;
    pub fn pacini_engine_calibrate(engine: pacini_engine, factor: f64, used: *mut f64) -> pacini_result;
    pub fn pacini_engine_set_actuator_gain(
        engine: pacini_engine,
        actuator: u32,
        gain: f64,
        glide: f64,
        frame: i64,
    ) -> pacini_result;

    pub fn pacini_play_settings_init(settings: *mut pacini_play_settings);
    pub fn pacini_play_start(
        engine: pacini_engine,
        clip: pacini_clip,
        settings: *const pacini_play_settings,
        play: *mut pacini_play,
    ) -> pacini_result;
    pub fn pacini_texture_start(
        engine: pacini_engine,
        texture: pacini_texture,
        speed: f64,
        force: f64,
        settings: *const pacini_play_settings,
        play: *mut pacini_play,
    ) -> pacini_result;
    pub fn pacini_play_set(play: pacini_play, control: i32, value: f64, glide: f64, frame: i64) -> pacini_result;
    pub fn pacini_play_stop(play: pacini_play, fade: f64, frame: i64) -> pacini_result;
    pub fn pacini_play_pause(play: pacini_play, fade: f64, frame: i64) -> pacini_result;
    pub fn pacini_play_resume(play: pacini_play, fade: f64, frame: i64) -> pacini_result;
    pub fn pacini_play_seek(play: pacini_play, position: f64, frame: i64) -> pacini_result;
    pub fn pacini_play_info_init(info: *mut pacini_play_info);
    pub fn pacini_play_get_info(play: pacini_play, info: *mut pacini_play_info) -> pacini_result;
    pub fn pacini_group_set(
        engine: pacini_engine,
        group: u32,
        control: i32,
        value: f64,
        glide: f64,
        frame: i64,
    ) -> pacini_result;
    pub fn pacini_group_stop(engine: pacini_engine, group: u32, fade: f64, frame: i64) -> pacini_result;

    pub fn pacini_controllers_find(
        controllers: *mut pacini_controller,
        capacity: u32,
        count: *mut u32,
    ) -> pacini_result;
    pub fn pacini_controller_info_init(info: *mut pacini_controller_info);
    pub fn pacini_controller_get_info(
        controller: pacini_controller,
        info: *mut pacini_controller_info,
    ) -> pacini_result;
    pub fn pacini_attach_settings_init(settings: *mut pacini_attach_settings);
    pub fn pacini_engine_attach(
        engine: pacini_engine,
        controller: pacini_controller,
        settings: *const pacini_attach_settings,
    ) -> pacini_result;
    pub fn pacini_engine_detach(engine: pacini_engine) -> pacini_result;
    pub fn pacini_attachment_info_init(info: *mut pacini_attachment_info);
    pub fn pacini_engine_get_attachment(engine: pacini_engine, info: *mut pacini_attachment_info) -> pacini_result;
}
