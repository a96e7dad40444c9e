//! Every function, in use and with what is not in use any more.
use pacini::{Actuator, Clip, Code, Config, Control, Engine, Error, Renderer, Settings, State};

const HUM: &str = r#"{"format": "pacini.clip", "version": 1, "name": "hüm", "duration": 1, "bands": [{"lowFrequency": 90,
 "centreFrequency": 100, "highFrequency": 110, "amplitude": [{"time": 0, "amplitude": 0.5}, {"time": 1, "amplitude": 0.5}]}]}"#;

fn hum() -> Clip {
    Clip::from_bytes(HUM.as_bytes()).unwrap()
}

fn two_actuators() -> Config {
    let actuators = vec![Actuator::default(), Actuator { gain: 0.5, ..Actuator::default() }];
    Config { actuators, sample_rate: 8000.0, max_plays: 8, ..Config::default() }
}

fn largest(renderer: &mut Renderer, frames: usize) -> [f32; 2] {
    let mut samples = vec![9.0f32; 2 * frames];
    renderer.render(&mut samples, 2).unwrap();
    let of = |channel: usize| samples.iter().skip(channel).step_by(2).fold(0.0f32, |most, x| most.max(x.abs()));
    [of(0), of(1)]
}

fn fails<T: std::fmt::Debug>(result: Result<T, Error>, code: Code, words: &str) {
    let error = result.unwrap_err();
    assert_eq!(error.code, code, "{}", error);
    assert!(error.to_string().contains(words), "{}", error);
}

#[test]
fn a_clip_plays_and_is_changed() {
    let clip = hum();
    let info = clip.info().unwrap();
    assert_eq!((info.name.as_str(), info.duration, info.events), ("hüm", 1.0, 0));
    assert!(info.bytes > 20);
    let two = Clip::all_from_bytes(&[HUM.as_bytes(), HUM.as_bytes()]).unwrap();
    assert_eq!(two.len(), 2);
    assert_eq!(two[1].info().unwrap().name, "hüm");
    fails(Clip::all_from_bytes(&[HUM.as_bytes(), b"none"]), Code::BadData, "bytes[1]: ");
    let (engine, mut renderer) = Engine::new(&two_actuators()).unwrap();
    let play = engine.play(&clip, &Settings { looped: -1.0, pan: 0.0, frame: 1000, ..Settings::default() }).unwrap();
    assert_eq!(play.state().unwrap(), State::Waiting);
    assert_eq!(largest(&mut renderer, 1000), [0.0, 0.0]);
    assert!(largest(&mut renderer, 1000)[0] > 0.4);
    assert_eq!(play.state().unwrap(), State::Playing);
    assert!((play.position().unwrap() - 0.125).abs() < 0.01);
    play.set(Control::Pan, 1.0, 0.0, 0).unwrap();
    largest(&mut renderer, 1000);
    let [left, right] = largest(&mut renderer, 1000);
    assert!(left == 0.0 && right > 0.2 && right < 0.26, "{} {}", left, right);
    engine.set_actuator_gain(1, 0.0, 0.0, 0).unwrap();
    largest(&mut renderer, 1000);
    assert_eq!(largest(&mut renderer, 1000), [0.0, 0.0]);
    engine.set_actuator_gain(1, 1.0, 0.0, 0).unwrap();
    clip.reload(HUM.replace("0.5", "0.1").as_bytes()).unwrap();
    largest(&mut renderer, 1000);
    let faint = largest(&mut renderer, 1000)[1];
    assert!(faint > 0.05 && faint < 0.15, "{}", faint);
    play.set(Control::Noise, 0.5, 0.0, 0).unwrap();
    play.set(Control::Events, 0.5, 0.0, 0).unwrap();
    engine.set_group(0, Control::Tones, 0.0, 0.0, 0).unwrap(); // all that is in this clip
    largest(&mut renderer, 1000);
    assert_eq!(largest(&mut renderer, 1000), [0.0, 0.0]);
    play.seek(0.5, 0).unwrap();
    play.pause(0.01, 0).unwrap();
    largest(&mut renderer, 1000);
    assert_eq!(play.state().unwrap(), State::Paused);
    play.resume(0.01, 0).unwrap();
    largest(&mut renderer, 1000);
    let info = engine.info().unwrap();
    assert_eq!((info.playing, info.frame, info.latency), (1, 12000, 8));
    engine.set_budget(0.0, 512, 1).unwrap();
    assert_eq!(engine.calibrate(2.5).unwrap(), 2.5);
    let second = engine.play(&clip, &Settings { priority: 5, ..Settings::default() }).unwrap();
    largest(&mut renderer, 100);
    assert_eq!(second.state().unwrap(), State::LeftOut);
    play.stop(0.01, 0).unwrap();
    engine.stop_group(0, 0.0, 0).unwrap();
    largest(&mut renderer, 1000);
    assert_eq!(play.state().unwrap(), State::Ended);
    fails(play.set(Control::Gain, 1.0, 0.0, 0), Code::Stale, "play: has ended");
}

#[test]
fn a_clip_has_markers() {
    let clip = Clip::from_bytes(
        r#"{"format": "pacini.clip", "version": 1, "duration": 1, "bands": [],
        "markers": [{"time": 0.25, "name": "schön"}, {"time": 0.5, "name": "step"}, {"time": 0.75, "name": "step"}]}"#
            .as_bytes(),
    )
    .unwrap();
    let markers = clip.markers().unwrap();
    assert_eq!(markers.iter().map(|one| one.name.as_str()).collect::<Vec<_>>(), ["schön", "step", "step"]);
    assert!((markers[0].time - 0.25).abs() < 1e-3);
    assert_eq!(clip.find_marker("schön", 0).unwrap(), markers[0]);
    assert_eq!(clip.find_marker("step", 2).unwrap(), markers[2]);
    fails(clip.find_marker("schön", 1), Code::Invalid, "no marker 'schön'");
    assert_eq!(hum().markers().unwrap(), []);
}

#[test]
fn channels_are_the_same_apart_and_interleaved() {
    let clip = hum();
    let (first, mut apart) = Engine::new(&two_actuators()).unwrap();
    let (second, mut mixed) = Engine::new(&two_actuators()).unwrap();
    for engine in [&first, &second] {
        engine.play(&clip, &Settings { pan: 0.3, ..Settings::default() }).unwrap();
    }
    let (mut left, mut right, mut third) = ([9.0; 500], [9.0; 500], [9.0; 500]);
    apart.render_channels(&mut [&mut left, &mut right, &mut third]).unwrap();
    let mut samples = [9.0; 1500];
    mixed.render(&mut samples, 3).unwrap();
    assert!(left.iter().any(|x| x.abs() > 0.1));
    for i in 0..500 {
        assert_eq!([left[i], right[i], third[i]], samples[3 * i..3 * i + 3]);
        assert_eq!(third[i], 0.0);
    }
    assert_eq!(apart.render_channels(&mut [&mut [0.0; 2], &mut [0.0; 3]]), Err(Code::Invalid));
    assert_eq!(apart.render(&mut [], 0), Ok(()));
}

#[test]
fn errors_say_why() {
    let clip = hum();
    let (engine, mut renderer) = Engine::new(&Config::default()).unwrap();
    fails(engine.play(&clip, &Settings { looped: 5.0, ..Settings::default() }), Code::Invalid, "loop");
    fails(Engine::new(&Config::with_profiles(&["lra-176"])), Code::Invalid, "'lra-176' is no profile");
    fails(Engine::new(&Config { actuators: vec![], ..Config::default() }), Code::Invalid, "actuator_count");
    fails(Engine::new(&Config::with_profiles(&["a\0b"])), Code::Invalid, "a 0 within");
    fails(Clip::load("dört/none"), Code::Io, "dört/none");
    fails(Clip::from_bytes(b"nonsense"), Code::BadData, "is not a clip");
    let play = engine.play(&clip, &Settings::default()).unwrap();
    drop(engine);
    let mut samples = [1.0f32; 8];
    assert_eq!(renderer.render(&mut samples, 1), Err(Code::Stale));
    assert_eq!(samples, [0.0; 8]);
    fails(play.stop(0.0, 0), Code::Stale, "engine of the play");
    fails(play.state(), Code::Stale, "engine of the play");
}

#[test]
fn what_is_dropped_is_destroyed() {
    for _ in 0..200 {
        Engine::new(&Config { sample_rate: 8000.0, max_plays: 4, ..Config::default() }).unwrap();
        // 64 at a time
    }
}

#[test]
fn the_renderer_is_for_another_thread() {
    let (engine, mut renderer) = Engine::new(&two_actuators()).unwrap();
    let audio = std::thread::spawn(move || {
        let mut most = 0.0f32;
        while most == 0.0 {
            most = largest(&mut renderer, 64)[0];
        }
        most
    });
    engine.play(&hum(), &Settings { looped: -1.0, ..Settings::default() }).unwrap();
    assert!(audio.join().unwrap() > 0.0);
}
