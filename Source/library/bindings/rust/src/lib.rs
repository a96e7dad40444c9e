//! Haptic clips that play at once on several actuators, started, moved and changed while they play: a safe wrapper of
//! libpacini.
//!
//! ```no_run
//! # fn main() -> Result<(), pacini::Error> {
//! let (engine, mut renderer) = pacini::Engine::new(&pacini::Config::with_profiles(&["lra-175"]))?;
//! let knock = pacini::Clip::load("knock.pacb")?;
//! engine.play(&knock, &pacini::Settings::default())?;
//! let mut drive = [0.0; 256];
//! let _ = renderer.render(&mut drive, 1); // in the audio callback, again and again
//! # Ok(())
//! # }
//! ```
//!
//! A [`Renderer`] goes to the audio thread: it neither allocates nor waits. Everything else may be called from any other
//! thread. Times in frames count from the first frame that the engine renders; those that have passed, such as 0, mean now.
#![warn(missing_docs)]

pub mod sys;

use std::ffi::{CStr, CString};
use std::fmt;
use std::mem::MaybeUninit;
use std::path::Path;

/// Why a call failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// An argument is out of its range.
    Invalid,
    /// What is called is not in use any more.
    Stale,
    /// Bytes are no clip, scene or profile.
    BadData,
    /// They were written by a newer version.
    Newer,
    /// Too many plays, commands, clips or engines, or too large.
    TooMany,
    /// A file cannot be read.
    Io,
    /// There is not enough memory.
    NoMemory,
    /// A defect of Pacini.
    Internal,
    /// It plays on a controller.
    Busy,
}

impl Code {
    fn of(result: sys::pacini_result) -> Self {
        match result {
            1 => Code::Invalid,
            2 => Code::Stale,
            3 => Code::BadData,
            4 => Code::Newer,
            5 => Code::TooMany,
            6 => Code::Io,
            7 => Code::NoMemory,
            9 => Code::Busy,
            _ => Code::Internal,
        }
    }
}

/// An error with its reason in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// Its kind.
    pub code: Code,
    /// Such as "loop: is longer than the clip".
    pub message: String,
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.message)
    }
}

impl std::error::Error for Error {}

fn check(result: sys::pacini_result) -> Result<(), Error> {
    if result == 0 {
        return Ok(());
    }
    // SAFETY: the library writes at most as many bytes as there are, with a 0 at the end; its texts are static.
    let message = unsafe {
        let mut text = vec![0u8; sys::pacini_last_error(std::ptr::null_mut(), 0)];
        sys::pacini_last_error(text.as_mut_ptr().cast(), text.len());
        text.pop();
        if text.is_empty() {
            text = CStr::from_ptr(sys::pacini_result_text(result)).to_bytes().to_vec();
        }
        String::from_utf8_lossy(&text).into_owned()
    };
    Err(Error { code: Code::of(result), message })
}

fn text(given: &str) -> Result<CString, Error> {
    CString::new(given).map_err(|_| Error { code: Code::Invalid, message: "a text has a 0 within".to_string() })
}

fn path(given: &Path) -> Result<CString, Error> {
    text(
        given
            .to_str()
            .ok_or_else(|| Error { code: Code::Invalid, message: format!("{}: is not UTF-8", given.display()) })?,
    )
}

/// A struct of the library as its init function fills it.
fn filled<Struct>(init: unsafe extern "C" fn(*mut Struct)) -> Struct {
    let mut made = MaybeUninit::zeroed();
    // SAFETY: all structs are plain numbers and pointers, for which zeros are valid; the function writes one of them.
    unsafe {
        init(made.as_mut_ptr());
        made.assume_init()
    }
}

/// Version of the interface of the linked library: major * 1000 + minor.
pub fn library_version() -> u32 {
    // SAFETY: it has no preconditions.
    unsafe { sys::pacini_api_version() }
}

// ---- Clips

/// What a clip is.
#[derive(Clone, Debug, PartialEq)]
pub struct ClipInfo {
    /// Cut if it is longer than 63 bytes.
    pub name: String,
    /// In seconds.
    pub duration: f64,
    /// Transients.
    pub events: u32,
    /// That it takes in memory.
    pub bytes: u64,
}

/// A named point of time of a clip.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// From 0, in order of time.
    pub index: u32,
    /// In seconds of the clip.
    pub time: f64,
    /// Cut if it is longer than 127 bytes.
    pub name: String,
}

impl Marker {
    fn of(info: &sys::pacini_marker_info) -> Marker {
        Marker { index: info.index, time: info.time, name: within(&info.name) }
    }
}

/// A haptic clip in memory. It can play as often as one likes, on any engine; when it is dropped, what plays of it goes on.
#[derive(Debug)]
pub struct Clip(sys::pacini_clip);

impl Clip {
    /// From the bytes of a file of any format that Pacini reads.
    pub fn from_bytes(bytes: &[u8]) -> Result<Clip, Error> {
        let mut handle = sys::pacini_clip::default();
        // SAFETY: as many bytes as it is told; the library copies them.
        check(unsafe { sys::pacini_clip_load(bytes.as_ptr().cast(), bytes.len(), &mut handle) })?;
        Ok(Clip(handle))
    }

    /// Of the bytes of several files: all, or an error about the first that is none.
    pub fn all_from_bytes(all: &[&[u8]]) -> Result<Vec<Clip>, Error> {
        let bytes: Vec<_> = all.iter().map(|one| one.as_ptr().cast()).collect();
        let sizes: Vec<_> = all.iter().map(|one| one.len()).collect();
        let mut handles = vec![sys::pacini_clip::default(); all.len()];
        // SAFETY: as many pointers, sizes and handles as it is told; the library copies the bytes.
        check(unsafe { sys::pacini_clips_load(bytes.as_ptr(), sizes.as_ptr(), all.len(), handles.as_mut_ptr()) })?;
        Ok(handles.into_iter().map(Clip).collect())
    }

    /// From a file.
    pub fn load(file: impl AsRef<Path>) -> Result<Clip, Error> {
        let file = path(file.as_ref())?;
        let mut handle = sys::pacini_clip::default();
        // SAFETY: the text ends with a 0.
        check(unsafe { sys::pacini_clip_load_file(file.as_ptr(), &mut handle) })?;
        Ok(Clip(handle))
    }

    /// Puts other content in its place; what plays of it fades over.
    pub fn reload(&self, bytes: &[u8]) -> Result<(), Error> {
        // SAFETY: as many bytes as it is told; the library copies them.
        check(unsafe { sys::pacini_clip_reload(self.0, bytes.as_ptr().cast(), bytes.len()) })
    }

    /// What it is.
    pub fn info(&self) -> Result<ClipInfo, Error> {
        let mut info = filled(sys::pacini_clip_info_init);
        // SAFETY: the struct knows its size; its name ends with a 0.
        let name = unsafe {
            check(sys::pacini_clip_get_info(self.0, &mut info))?;
            CStr::from_ptr(info.name.as_ptr()).to_string_lossy().into_owned()
        };
        Ok(ClipInfo { name, duration: info.duration, events: info.events, bytes: info.bytes })
    }

    /// Its markers, in order of time. A loop of a WAV is two of them, "loop start" and "loop end".
    pub fn markers(&self) -> Result<Vec<Marker>, Error> {
        let mut count = 0;
        // SAFETY: `count` outlives the call.
        check(unsafe { sys::pacini_clip_count_markers(self.0, &mut count) })?;
        (0..count)
            .map(|index| {
                let mut info = filled(sys::pacini_marker_info_init);
                // SAFETY: the struct knows its size.
                check(unsafe { sys::pacini_clip_get_marker(self.0, index, &mut info) })?;
                Ok(Marker::of(&info))
            })
            .collect()
    }

    /// The first marker with this name, from the marker `index` on.
    pub fn find_marker(&self, name: &str, index: u32) -> Result<Marker, Error> {
        let name = text(name)?;
        let mut info = filled(sys::pacini_marker_info_init);
        // SAFETY: the struct knows its size, and the text ends with a 0.
        check(unsafe { sys::pacini_clip_find_marker(self.0, name.as_ptr(), index, &mut info) })?;
        Ok(Marker::of(&info))
    }
}

/// What a hand feels of a surface: made of a recording by `pacini texture analyse`, played by speed and force.
#[derive(Debug)]
pub struct Texture(sys::pacini_texture);

impl Texture {
    /// From the bytes of a texture file.
    pub fn from_bytes(bytes: &[u8]) -> Result<Texture, Error> {
        let mut handle = sys::pacini_texture::default();
        // SAFETY: as many bytes as it is told; the library copies them.
        check(unsafe { sys::pacini_texture_load(bytes.as_ptr().cast(), bytes.len(), &mut handle) })?;
        Ok(Texture(handle))
    }

    /// From a file.
    pub fn load(file: impl AsRef<Path>) -> Result<Texture, Error> {
        let file = path(file.as_ref())?;
        let mut handle = sys::pacini_texture::default();
        // SAFETY: the text ends with a 0.
        check(unsafe { sys::pacini_texture_load_file(file.as_ptr(), &mut handle) })?;
        Ok(Texture(handle))
    }
}

impl Drop for Texture {
    fn drop(&mut self) {
        // SAFETY: handles are checked by the library.
        unsafe { sys::pacini_texture_release(self.0) };
    }
}

impl Drop for Clip {
    fn drop(&mut self) {
        // SAFETY: handles are checked by the library.
        unsafe { sys::pacini_clip_release(self.0) };
    }
}

// ---- Engines

/// How a pan between actuators is heard, or felt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PanLaw {
    /// By level between the two nearest actuators; the power stays.
    Power = 0,
    /// By time: the farther an actuator the later.
    Delay = 1,
    /// Both.
    Both = 2,
}

/// One of the actuators of an engine.
#[derive(Clone, Debug, PartialEq)]
pub struct Actuator {
    /// Name of a profile that comes with Pacini, or the text of one in JSON; None: the drive signal as it is.
    pub profile: Option<String>,
    /// Linear, 0 to 1, behind the protection.
    pub gain: f64,
    /// In seconds, 0 to 1.
    pub delay: f64,
}

impl Default for Actuator {
    fn default() -> Self {
        Actuator { profile: None, gain: 1.0, delay: 0.0 }
    }
}

/// What an engine is made for; the defaults are the library's. pacini.h has the ranges.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// 1 to 16, in a row from pan 0 to pan 1.
    pub actuators: Vec<Actuator>,
    /// In Hz.
    pub sample_rate: f64,
    /// How plays are panned.
    pub pan_law: PanLaw,
    /// Keep within full drive and the limits of the profiles.
    pub protect: bool,
    /// In seconds for the whole row.
    pub pan_delay: f64,
    /// In seconds that a play may be delayed by.
    pub longest_delay: f64,
    /// 0 (as flat as can be) to 1 (as strong as can be).
    pub strength: f64,
    /// At a time.
    pub max_plays: u32,
    /// That wait.
    pub max_commands: u32,
    /// Microseconds for a block of `budget_frames` that plays may take, by prediction; 0: all.
    pub budget: f64,
    /// Frames of that block.
    pub budget_frames: u32,
    /// Plays that sound at a time; 0: all.
    pub budget_voices: u32,
}

impl Default for Config {
    fn default() -> Self {
        assert!((1005..2000).contains(&library_version()), "libpacini has another interface than this crate");
        let usual = filled(sys::pacini_engine_config_init);
        Config {
            actuators: vec![Actuator::default()],
            sample_rate: usual.sample_rate,
            pan_law: PanLaw::Power,
            protect: usual.protect != 0,
            pan_delay: usual.pan_delay,
            longest_delay: usual.longest_delay,
            strength: usual.strength,
            max_plays: usual.max_plays,
            max_commands: usual.max_commands,
            budget: usual.budget,
            budget_frames: usual.budget_frames,
            budget_voices: usual.budget_voices,
        }
    }
}

impl Config {
    /// With an actuator for each of these profiles.
    pub fn with_profiles(profiles: &[&str]) -> Self {
        let actuators =
            profiles.iter().map(|name| Actuator { profile: Some(name.to_string()), ..Actuator::default() }).collect();
        Config { actuators, ..Config::default() }
    }

    fn create(&self, scene: Option<&Path>) -> Result<sys::pacini_engine, Error> {
        let mut config = filled(sys::pacini_engine_config_init);
        config.actuator_count = self.actuators.len() as u32;
        config.sample_rate = self.sample_rate;
        config.pan_law = self.pan_law as i32;
        config.protect = i32::from(self.protect);
        config.pan_delay = self.pan_delay;
        config.longest_delay = self.longest_delay;
        config.strength = self.strength;
        config.max_plays = self.max_plays;
        config.max_commands = self.max_commands;
        config.budget = self.budget;
        config.budget_frames = self.budget_frames;
        config.budget_voices = self.budget_voices;
        let mut profiles = Vec::new(); // lives until the engine is there
        for (to, from) in config.actuators.iter_mut().zip(&self.actuators) {
            to.gain = from.gain;
            to.delay = from.delay;
            if let Some(profile) = &from.profile {
                let profile = text(profile)?;
                to.profile = profile.as_ptr();
                profiles.push(profile);
            }
        }
        let mut handle = sys::pacini_engine::default();
        match scene {
            // SAFETY: the struct knows its size, and its texts end with a 0 and live until the call returns.
            None => check(unsafe { sys::pacini_engine_create(&config, &mut handle) })?,
            Some(file) => {
                let file = path(file)?;
                // SAFETY: as above.
                check(unsafe { sys::pacini_engine_create_scene(&config, file.as_ptr(), &mut handle) })?;
            }
        }
        Ok(handle)
    }
}

/// What an engine does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EngineInfo {
    /// Frames that a command must come ahead to be exact.
    pub latency: u32,
    /// Frames rendered so far.
    pub frame: i64,
    /// Plays that sound.
    pub playing: u32,
    /// Plays for which there is no time or voice.
    pub left_out: u32,
    /// Microseconds that a block of `budget_frames` is predicted to take.
    pub cost: f64,
    /// dB: energy left out so far, below all that was to play; -1000 for none.
    pub left_out_error: f64,
    /// dB that the protection of any actuator took in the last block.
    pub gain_reduction: f64,
}

/// Plays clips on up to 16 actuators. Ends, with all its plays, when it is dropped.
#[derive(Debug)]
pub struct Engine(sys::pacini_engine);

/// What the audio thread has of an engine.
#[derive(Debug)]
pub struct Renderer(sys::pacini_engine);

impl Engine {
    /// The engine, and its part for the audio thread.
    pub fn new(config: &Config) -> Result<(Engine, Renderer), Error> {
        let handle = config.create(None)?;
        Ok((Engine(handle), Renderer(handle)))
    }

    /// One that plays a scene file by itself from frame 0 on, and whatever is started beside it.
    pub fn with_scene(config: &Config, scene: impl AsRef<Path>) -> Result<(Engine, Renderer), Error> {
        let handle = config.create(Some(scene.as_ref()))?;
        Ok((Engine(handle), Renderer(handle)))
    }

    /// Starts a clip.
    pub fn play(&self, clip: &Clip, settings: &Settings) -> Result<Play, Error> {
        let settings = settings.to_struct();
        let mut play = sys::pacini_play::default();
        // SAFETY: the struct knows its size.
        check(unsafe { sys::pacini_play_start(self.0, clip.0, &settings, &mut play) })?;
        Ok(Play(play))
    }

    /// Starts a texture, which plays until it is stopped; set `Control::TextureSpeed` and `Control::TextureForce` (0 to
    /// 1) while it does.
    pub fn play_texture(&self, texture: &Texture, speed: f64, force: f64, settings: &Settings) -> Result<Play, Error> {
        let settings = settings.to_struct();
        let mut play = sys::pacini_play::default();
        // SAFETY: the struct knows its size.
        check(unsafe { sys::pacini_texture_start(self.0, texture.0, speed, force, &settings, &mut play) })?;
        Ok(Play(play))
    }

    /// What it does.
    pub fn info(&self) -> Result<EngineInfo, Error> {
        let mut info = filled(sys::pacini_engine_info_init);
        // SAFETY: the struct knows its size.
        check(unsafe { sys::pacini_engine_get_info(self.0, &mut info) })?;
        Ok(EngineInfo {
            latency: info.latency,
            frame: info.frame,
            playing: info.playing,
            left_out: info.left_out,
            cost: info.cost,
            left_out_error: info.left_out_error,
            gain_reduction: info.gain_reduction,
        })
    }

    /// What may play at a time: microseconds for a block of so many frames, and voices; 0: all.
    pub fn set_budget(&self, microseconds: f64, frames: u32, voices: u32) -> Result<(), Error> {
        // SAFETY: numbers are checked by the library, here and in what follows.
        check(unsafe { sys::pacini_engine_set_budget(self.0, microseconds, frames, voices) })
    }

    /// How many times as long as predicted blocks take on this machine; 0 measures it of the last ones. Returns it.
    pub fn calibrate(&self, factor: f64) -> Result<f64, Error> {
        let mut used = 0.0;
        // SAFETY: `used` outlives the call.
        check(unsafe { sys::pacini_engine_calibrate(self.0, factor, &mut used) })?;
        Ok(used)
    }

    /// Gain of an actuator, the first is 0, behind its protection.
    pub fn set_actuator_gain(&self, actuator: u32, gain: f64, glide: f64, frame: i64) -> Result<(), Error> {
        check(unsafe { sys::pacini_engine_set_actuator_gain(self.0, actuator, gain, glide, frame) })
    }

    /// A control of all plays of a group, 0 to 31.
    pub fn set_group(&self, group: u32, control: Control, value: f64, glide: f64, frame: i64) -> Result<(), Error> {
        check(unsafe { sys::pacini_group_set(self.0, group, control as i32, value, glide, frame) })
    }

    /// Plays on a controller from now on, on a thread of the library; rendering is `Code::Busy` meanwhile.
    /// `stop_on_crash` silences it when the program crashes, by handlers of signals.
    pub fn attach(&self, controller: Controller, stop_on_crash: bool) -> Result<(), Error> {
        let mut settings = filled(sys::pacini_attach_settings_init);
        settings.stop_on_crash = i32::from(stop_on_crash);
        // SAFETY: the struct knows its size.
        check(unsafe { sys::pacini_engine_attach(self.0, controller.0, &settings) })
    }

    /// Silences the controller and gives the engine back to its renderer.
    pub fn detach(&self) -> Result<(), Error> {
        check(unsafe { sys::pacini_engine_detach(self.0) })
    }

    /// Whether it plays on a controller.
    pub fn attachment(&self) -> Result<Attachment, Error> {
        let mut info = filled(sys::pacini_attachment_info_init);
        // SAFETY: the struct knows its size.
        check(unsafe { sys::pacini_engine_get_attachment(self.0, &mut info) })?;
        Ok(match info.state {
            1 => Attachment::Attached { sent: info.sent },
            2 => Attachment::Gone { failure: within(&info.failure) },
            _ => Attachment::Detached,
        })
    }

    /// Fades (s) all plays of a group out and ends them.
    pub fn stop_group(&self, group: u32, fade: f64, frame: i64) -> Result<(), Error> {
        check(unsafe { sys::pacini_group_stop(self.0, group, fade, frame) })
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        // SAFETY: handles are checked; it waits for a block that is being rendered.
        unsafe { sys::pacini_engine_destroy(self.0) };
    }
}

impl Renderer {
    /// The next frames, frame by frame: `samples[frame * channels + actuator]`. Channels beyond the actuators are silent,
    /// and all of them when the engine is gone, which is an error.
    pub fn render(&mut self, samples: &mut [f32], channels: usize) -> Result<(), Code> {
        let frames = samples.len().checked_div(channels).unwrap_or(0);
        // SAFETY: no more than frames * channels samples are written; nobody else can render this engine meanwhile.
        match unsafe { sys::pacini_render_interleaved(self.0, samples.as_mut_ptr(), channels as u32, frames as u32) } {
            0 => Ok(()),
            code => Err(Code::of(code)),
        }
    }

    /// The same with a slice for each actuator, 16 at most, of equal lengths.
    pub fn render_channels(&mut self, channels: &mut [&mut [f32]]) -> Result<(), Code> {
        let frames = channels.first().map_or(0, |first| first.len());
        if channels.len() > 16 || channels.iter().any(|channel| channel.len() != frames) {
            return Err(Code::Invalid);
        }
        let mut pointers = [std::ptr::null_mut(); 16];
        for (to, from) in pointers.iter_mut().zip(channels.iter_mut()) {
            *to = from.as_mut_ptr();
        }
        // SAFETY: as many pointers as it is told, to as many samples each.
        match unsafe { sys::pacini_render(self.0, pointers.as_ptr(), channels.len() as u32, frames as u32) } {
            0 => Ok(()),
            code => Err(Code::of(code)),
        }
    }
}

// ---- Game controllers

/// A text in a struct of the library.
fn within(text: &[std::os::raw::c_char]) -> String {
    let bytes: Vec<u8> = text.iter().take_while(|&&c| c != 0).map(|&c| c as u8).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// A game controller, or another haptic device: a number, which keeps as long as it is connected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Controller(sys::pacini_controller);

/// What a controller is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ControllerInfo {
    /// As the controller gives it.
    pub name: String,
    /// What the system calls it.
    pub path: String,
    /// A pacini_haptics.
    pub haptics: i32,
    /// A pacini_connection.
    pub connection: i32,
}

/// Whether an engine plays on a controller.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Attachment {
    /// It does not.
    Detached,
    /// It does.
    Attached {
        /// Reports so far.
        sent: u64,
    },
    /// The controller is unplugged or switched off; the engine goes on unfelt until it is detached.
    Gone {
        /// Why, in words.
        failure: String,
    },
}

/// What is connected. Takes up to 0.1 s.
pub fn controllers() -> Result<Vec<Controller>, Error> {
    let mut handles = [sys::pacini_controller::default(); 32];
    let mut count = 0;
    // SAFETY: no more handles are written than there is room for.
    check(unsafe { sys::pacini_controllers_find(handles.as_mut_ptr(), 32, &mut count) })?;
    Ok(handles.iter().take(count as usize).map(|&handle| Controller(handle)).collect())
}

impl Controller {
    /// What it is.
    pub fn info(&self) -> Result<ControllerInfo, Error> {
        let mut info = filled(sys::pacini_controller_info_init);
        // SAFETY: the struct knows its size.
        check(unsafe { sys::pacini_controller_get_info(self.0, &mut info) })?;
        Ok(ControllerInfo {
            name: within(&info.name),
            path: within(&info.path),
            haptics: info.haptics,
            connection: info.connection,
        })
    }
}

// ---- Plays

/// What can be changed while a clip plays; pacini.h has the ranges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Control {
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
    TextureForce = 11,
}

/// How a clip is played; the defaults are the library's: once, now, in the middle, as it is. pacini.h has the ranges.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct Settings {
    pub group: u32,
    /// At which it begins.
    pub frame: i64,
    pub gain: f64,
    pub intensity: f64,
    pub pan: f64,
    pub delay: f64,
    pub transposition: f64,
    pub speed: f64,
    /// Seconds of the clip at which it begins.
    pub from: f64,
    /// Seconds of the clip that are repeated; 0: play once; -1: the whole clip.
    pub looped: f64,
    /// Of a loop; 0: until it is stopped.
    pub passes: u32,
    /// 0 is kept longest.
    pub priority: i32,
    /// Semitones by which it may be transposed up later without loss.
    pub headroom: f64,
    pub fade_in: f64,
    /// 0 to 1: amplitudes vary at random, from pass to pass.
    pub variation: f64,
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        let usual = filled(sys::pacini_play_settings_init);
        Settings {
            group: usual.group,
            frame: usual.frame,
            gain: usual.gain,
            intensity: usual.intensity,
            pan: usual.pan,
            delay: usual.delay,
            transposition: usual.transposition,
            speed: usual.speed,
            from: usual.from,
            looped: usual.r#loop,
            passes: usual.passes,
            priority: usual.priority,
            headroom: usual.headroom,
            fade_in: usual.fade_in,
            variation: usual.variation,
            seed: usual.seed,
        }
    }
}

impl Settings {
    fn to_struct(&self) -> sys::pacini_play_settings {
        sys::pacini_play_settings {
            group: self.group,
            frame: self.frame,
            gain: self.gain,
            intensity: self.intensity,
            pan: self.pan,
            delay: self.delay,
            transposition: self.transposition,
            speed: self.speed,
            from: self.from,
            r#loop: self.looped,
            passes: self.passes,
            priority: self.priority,
            headroom: self.headroom,
            fade_in: self.fade_in,
            variation: self.variation,
            seed: self.seed,
            ..filled(sys::pacini_play_settings_init)
        }
    }
}

/// Where a play is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// At its end, or stopped.
    Ended,
    /// For its frame.
    Waiting,
    /// It sounds.
    Playing,
    /// It waits to be resumed.
    Paused,
    /// There is no time or voice for it.
    LeftOut,
}

/// A clip that plays: a number, which may be copied. When it has ended, everything but `state` and `position` is an error,
/// [`Code::Stale`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Play(sys::pacini_play);

impl Play {
    /// Glides (s) in a straight line, from a frame on.
    pub fn set(&self, control: Control, value: f64, glide: f64, frame: i64) -> Result<(), Error> {
        // SAFETY: numbers are checked by the library, here and in what follows.
        check(unsafe { sys::pacini_play_set(self.0, control as i32, value, glide, frame) })
    }

    /// Fades (s) out and ends.
    pub fn stop(&self, fade: f64, frame: i64) -> Result<(), Error> {
        check(unsafe { sys::pacini_play_stop(self.0, fade, frame) })
    }

    /// Fades (s) out and waits where it is.
    pub fn pause(&self, fade: f64, frame: i64) -> Result<(), Error> {
        check(unsafe { sys::pacini_play_pause(self.0, fade, frame) })
    }

    /// Goes on.
    pub fn resume(&self, fade: f64, frame: i64) -> Result<(), Error> {
        check(unsafe { sys::pacini_play_resume(self.0, fade, frame) })
    }

    /// Goes on at another second of the clip.
    pub fn seek(&self, position: f64, frame: i64) -> Result<(), Error> {
        check(unsafe { sys::pacini_play_seek(self.0, position, frame) })
    }

    fn info(&self) -> Result<sys::pacini_play_info, Error> {
        let mut info = filled(sys::pacini_play_info_init);
        check(unsafe { sys::pacini_play_get_info(self.0, &mut info) })?;
        Ok(info)
    }

    /// Where it is, as long as its engine lives.
    pub fn state(&self) -> Result<State, Error> {
        Ok(match self.info()?.state {
            1 => State::Waiting,
            2 => State::Playing,
            3 => State::Paused,
            4 => State::LeftOut,
            _ => State::Ended,
        })
    }

    /// Seconds of the clip.
    pub fn position(&self) -> Result<f64, Error> {
        Ok(self.info()?.position)
    }
}
