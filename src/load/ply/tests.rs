mod clips;
mod faults;
mod forms;
mod gaussians;
mod limits;
mod meshes;
mod mutations;
mod other_reader;
mod splats;

use std::path::Path;

use crate::{
    error::Result,
    load::{Limits, LoadOptions, Loaded, Model, input::Input},
    scene::{Colors, Mesh, Points, Splats},
};

fn load_within(bytes: &[u8], limits: Limits) -> Result<Loaded> {
    let options = LoadOptions { limits, ..LoadOptions::default() };
    super::parse(&Input { path: Path::new("a.ply"), folder: None, bytes, options: &options, progress: &() })
}

fn load(bytes: &[u8]) -> Result<Loaded> {
    load_within(bytes, Limits::DEFAULT)
}

fn parse(bytes: &[u8]) -> Result<Model> {
    load(bytes).map(|loaded| loaded.model)
}

/// What was noted of a file.
fn notes(bytes: &[u8]) -> Vec<String> {
    load(bytes).unwrap().notes.iter().map(ToString::to_string).collect()
}

fn points(bytes: &[u8]) -> Points {
    match parse(bytes).unwrap() {
        Model::Points(points) => points,
        _ => panic!("no points"),
    }
}

fn each_color(colors: &Colors) -> Vec<[f32; 4]> {
    match colors {
        Colors::Each(colors) => colors.clone(),
        Colors::Uniform(_) => panic!("one color"),
    }
}

fn splats(bytes: &[u8]) -> Splats {
    match parse(bytes).unwrap() {
        Model::Splats { splats, .. } => splats,
        _ => panic!("no splats"),
    }
}

fn mesh(bytes: &[u8]) -> Mesh {
    match parse(bytes).unwrap() {
        Model::Mesh(mesh) => mesh,
        _ => panic!("no mesh"),
    }
}

/// One value of a body.
#[derive(Clone, Copy)]
enum Value {
    Char(i8),
    UChar(u8),
    Short(i16),
    UShort(u16),
    Int(i32),
    UInt(u32),
    Float(f32),
    Double(f64),
}

/// The same elements in the three encodings; each inner list is one element. The header may hold `ENCODING`.
fn encodings(header: &str, elements: &[Vec<Value>]) -> [Vec<u8>; 3] {
    ["ascii", "binary_little_endian", "binary_big_endian"].map(|encoding| {
        let mut file = header.replace("ENCODING", encoding).into_bytes();
        for element in elements {
            for value in element {
                macro_rules! write {
                    ($v:expr) => {
                        match encoding {
                            "ascii" => file.extend(format!("{} ", $v).bytes()),
                            "binary_little_endian" => file.extend($v.to_le_bytes()),
                            _ => file.extend($v.to_be_bytes()),
                        }
                    };
                }
                match value {
                    Value::Char(v) => write!(v),
                    Value::UChar(v) => write!(v),
                    Value::Short(v) => write!(v),
                    Value::UShort(v) => write!(v),
                    Value::Int(v) => write!(v),
                    Value::UInt(v) => write!(v),
                    Value::Float(v) => write!(v),
                    Value::Double(v) => write!(v),
                }
            }
            if encoding == "ascii" {
                file.push(b'\n');
            }
        }
        file
    })
}
