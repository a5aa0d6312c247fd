//! `surfel bench counts`.

use std::{fs, path::PathBuf, process::Command};

#[test]
fn compilers_of_real_chips_make_instructions_of_every_pipeline() {
    let radv = PathBuf::from("/usr/share/vulkan/icd.d");
    let mut drivers = fs::read_dir(radv).into_iter().flatten().flatten();
    if !drivers.any(|file| file.file_name().to_string_lossy().starts_with("radeon_icd")) {
        assert!(std::env::var_os("CI").is_none(), "RADV is not installed (package mesa-vulkan-drivers)");
        eprintln!("NOT CHECKED: RADV is not installed (package mesa-vulkan-drivers)");
        return;
    }
    let folder = temp_dir::TempDir::new().unwrap();
    let json = folder.path().join("counts.json");
    let mut surfel = Command::new(env!("CARGO_BIN_EXE_surfel"));
    // RDNA2 and GCN 5.
    surfel.args(["bench", "counts", "--isa", "NAVI21,vega10", "--json"]).arg(&json);
    let output = surfel.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&fs::read(json).unwrap()).unwrap();
    let mut compiled = 0;
    for row in report["counts"]["rows"].as_array().unwrap() {
        let programs = row["isa"].as_array().unwrap();
        let name = |key: &str| row[key].as_str().unwrap();
        // The ray casting of 2005 is only counted.
        let stages = match (name("pass").starts_with("botsch"), name("shaders").ends_with(".comp")) {
            (true, _) => 0,
            (false, true) => 1,
            (false, false) => 2,
        };
        for chip in ["NAVI21", "VEGA10"] {
            let own: Vec<_> = programs.iter().filter(|program| program["device"] == chip).collect();
            assert_eq!(own.len(), stages, "{row}");
            for program in own {
                let statistics = program["statistics"].as_array().unwrap();
                let figure = |name: &str| {
                    let found = statistics.iter().find(|one| one[0] == name).unwrap();
                    found[1].as_f64().unwrap()
                };
                let all_above_0 = ["Instructions", "VGPRs", "SGPRs", "Code size", "Latency"]
                    .iter()
                    .all(|name| figure(name) > 0.0);
                assert!(all_above_0, "{program}");
                compiled += 1;
            }
        }
    }
    assert!(compiled > 100, "{compiled}");
}
