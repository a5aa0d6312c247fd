//! The header is what the source says.

use std::{env, fs, path::Path, process::Command};

#[test]
fn the_header_is_made_of_the_source() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    // The folder of builds that this test is from.
    let target = env::current_exe().unwrap();
    let target = target.ancestors().nth(3).unwrap();
    cargo.args(["run", "--quiet", "--locked", "--manifest-path"]);
    let run = cargo.arg(folder.join("header/Cargo.toml")).arg("--target-dir").arg(target).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let (made, file) = (String::from_utf8(run.stdout).unwrap(), folder.join("include/surfel.h"));
    if env::var_os("SURFEL_UPDATE_SNAPSHOTS").is_some() {
        fs::write(&file, &made).unwrap();
    }
    let is = fs::read_to_string(&file).unwrap_or_default();
    assert!(is == made, "include/surfel.h is not up to date: SURFEL_UPDATE_SNAPSHOTS=1 writes it anew");
}
