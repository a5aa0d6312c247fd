//! Prints the header of the C interface: `cargo run --manifest-path capi/header/Cargo.toml`.

use std::{error::Error, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let capi = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let config = cbindgen::Config::from_file(capi.join("cbindgen.toml"))?;
    let builder = cbindgen::Builder::new().with_config(config).with_src(capi.join("src/lib.rs"));
    builder.generate()?.write(std::io::stdout());
    Ok(())
}
