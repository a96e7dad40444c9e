//! Links libpacini: from the folder that PACINI_LIB_DIR names, or from where the system has its libraries.

fn main() {
    println!("cargo:rerun-if-env-changed=PACINI_LIB_DIR");
    if let Ok(folder) = std::env::var("PACINI_LIB_DIR") {
        println!("cargo:rustc-link-search=native={}", folder);
        if std::env::var("CARGO_CFG_UNIX").is_ok() {
            println!("cargo:rustc-link-arg=-Wl,-rpath,{}", folder); // of the tests and examples of this crate
        }
    }
    println!("cargo:rustc-link-lib=dylib=pacini");
}
