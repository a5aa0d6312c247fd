//! Tells the program which commit it is built from.

use std::{path::Path, process::Command};

/// Reports name the commit they were made from, as `SURFEL_COMMIT`: in a checkout, not in a package.
fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let git = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).output().ok().filter(|o| o.status.success())?;
        Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
    };
    // Not that of a repository which this folder happens to lie in.
    let is_ours = git(&["rev-parse", "--show-prefix"]).is_some_and(|prefix| prefix == "program/");
    if let (true, Some(commit)) = (is_ours, git(&["rev-parse", "--short=12", "HEAD"])) {
        println!("cargo::rustc-env=SURFEL_COMMIT={commit}");
        // Written by each commit and each checkout.
        if let Some(log) =
            git(&["rev-parse", "--git-path", "logs/HEAD"]).filter(|log| Path::new(log).exists())
        {
            println!("cargo::rerun-if-changed={log}");
        }
    }
}
