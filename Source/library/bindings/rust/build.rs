//! Links libpacini: from the folder that PACINI_LIB_DIR names, else from where pkg-config finds pacini.pc, else from where
//! the system has its libraries.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The folders of libraries that pkg-config names, if it knows libpacini.
fn folders_of_pkg_config() -> Option<Vec<PathBuf>> {
    let program = std::env::var("PKG_CONFIG").unwrap_or_else(|_| "pkg-config".to_string());
    // Folders of the system are left out, unless they are asked for.
    let said = Command::new(program).args(["--libs-only-L", "pacini"]).env("PKG_CONFIG_ALLOW_SYSTEM_LIBS", "1").output();
    let said = said.ok().filter(|done| done.status.success())?;
    let text = String::from_utf8(said.stdout).ok()?;
    Some(text.split_whitespace().filter_map(|word| word.strip_prefix("-L")).map(PathBuf::from).collect())
}

/// Whether the folder has a library that can be linked.
fn has_library(folder: &Path) -> bool {
    ["libpacini.so", "libpacini.dylib", "libpacini.a", "pacini.lib", "libpacini.dll.a", "pacini.dll"]
        .iter()
        .any(|name| folder.join(name).exists())
}

/// Links from a folder, in which the tests and examples of this crate also find the library when they run.
fn link_from(folder: &Path) {
    println!("cargo:rustc-link-search=native={}", folder.display());
    if std::env::var("CARGO_CFG_UNIX").is_ok() {
        println!("cargo:rustc-link-arg=-Wl,-rpath,{}", folder.display());
    }
}

fn main() {
    for name in ["PACINI_LIB_DIR", "PKG_CONFIG", "PKG_CONFIG_PATH"] {
        println!("cargo:rerun-if-env-changed={}", name);
    }
    println!("cargo:rustc-link-lib=dylib=pacini");
    if let Some(folder) = std::env::var_os("PACINI_LIB_DIR").map(PathBuf::from) {
        if !has_library(&folder) {
            println!("cargo:warning=PACINI_LIB_DIR is {}, which has no libpacini", folder.display());
        }
        link_from(&folder);
        return;
    }
    if let Some(folders) = folders_of_pkg_config() {
        folders.iter().for_each(|folder| link_from(folder));
        return;
    }
    let usual = ["/usr/lib", "/usr/lib64", "/usr/local/lib", "/opt/homebrew/lib"];
    let multiarch = std::env::var("CARGO_CFG_TARGET_ARCH").map(|arch| format!("/usr/lib/{}-linux-gnu", arch));
    if !usual.iter().map(|folder| folder.to_string()).chain(multiarch).any(|folder| has_library(Path::new(&folder))) {
        println!(
            "cargo:warning=libpacini is not found: pkg-config does not know pacini, and the system's folders have none. Set \
             PACINI_LIB_DIR to the folder of libpacini, such as build/release/lib"
        );
    }
}
