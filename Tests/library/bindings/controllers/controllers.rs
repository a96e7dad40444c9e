//! Plays a clip on the first controller and prints what happens.
use pacini::{controllers, Attachment, Clip, Code, Config, Engine, Settings, State};

fn main() -> Result<(), pacini::Error> {
    let found = controllers()?;
    assert_eq!(found.len(), 1);
    let info = found[0].info()?;
    println!("{} {} {}", info.name, info.haptics, info.connection);
    let (engine, mut renderer) = Engine::new(&Config::default())?;
    engine.attach(found[0], false)?;
    assert_eq!(renderer.render(&mut [0.0; 8], 1), Err(Code::Busy));
    let play = engine.play(&Clip::load(std::env::args().nth(1).unwrap())?, &Settings::default())?;
    while play.state()? != State::Ended {
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    assert!(matches!(engine.attachment()?, Attachment::Attached { sent } if sent > 20));
    println!("attached");
    engine.detach()?;
    assert_eq!(engine.attachment()?, Attachment::Detached);
    println!("detached");
    assert_eq!(renderer.render(&mut [0.0; 8], 1), Ok(()));
    assert_eq!(engine.detach().unwrap_err().code, Code::Invalid);
    Ok(())
}
