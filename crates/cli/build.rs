//! Lists the files of the playground, which `scripts/web.sh` puts into `playground/`, for `tiny-physics play`. Without
//! them the program is the same but for that command.

use std::path::Path;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=playground");
    let folder =
        Path::new(&env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it")).join("playground");
    let mut names: Vec<_> = fs::read_dir(&folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| !name.starts_with('.') && name != "README.md")
        .collect();
    names.sort();
    let lines = names.iter().map(|name| {
        let path = folder.join(name);
        format!("    ({name:?}, include_bytes!({:?})),\n", path.to_str().expect("a readable path"))
    });
    let list: String = lines.collect();
    let text = format!("&[\n{list}]\n");
    let out = env::var_os("OUT_DIR").expect("cargo sets it");
    fs::write(Path::new(&out).join("playground.rs"), text)
        .expect("the build folder can be written to");
}
