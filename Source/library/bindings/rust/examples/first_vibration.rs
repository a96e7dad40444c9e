//! The first vibration: loads a clip, plays it and writes what drives the actuator as raw 32-bit floats.
use std::io::Write;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).ok_or("usage: first_vibration CLIP")?;
    let (engine, mut renderer) = pacini::Engine::new(&pacini::Config::with_profiles(&["lra-175"]))?;
    let knock = pacini::Clip::load(file)?;
    engine.play(&knock, &pacini::Settings::default())?;
    let mut drive = [0.0f32; 256];
    for _ in 0..188 {
        renderer.render(&mut drive, 1).expect("the engine lives");
        for sample in drive {
            std::io::stdout().write_all(&sample.to_ne_bytes())?;
        }
    }
    Ok(())
}
