//! From `glsl/` to SPIR-V in Rust's hands. Part of `build.rs`, of the test `tests/plain/shaders.rs`, and, with the feature `live-shaders`, of the program.

mod compile;
mod config;
mod exact;
mod layout;
mod permutations;
mod spirv;
mod table;
mod unroll;

use std::{
    collections::{BTreeMap, BTreeSet},
    env, fs, io,
    num::NonZero,
    panic,
    path::{Path, PathBuf},
    sync::atomic::{AtomicUsize, Ordering},
    thread,
};

use compile::{Compiler, Optimize};
use layout::{StructLayout, struct_layouts};

/// A struct that host and shaders share: its name in GLSL, and the path of its twin in Rust.
pub type HostStruct<'a> = (&'a str, &'a str);

/// The structs that host and shaders share: name in GLSL, path of the twin in Rust. The build checks every member's offset, and the size; a
/// listed struct that no shader has is an error.
#[allow(dead_code, reason = "the tests of the build have structs of their own")]
pub const HOST_STRUCTS: &[HostStruct] = &[
    ("FrameConstants", "crate::passes::FrameConstants"),
    ("PaperConstants", "crate::passes::PaperConstants"),
    ("FinalizeConstants", "crate::passes::FinalizeConstants"),
    ("HostDepth", "crate::passes::HostDepth"),
    ("HostObject", "crate::passes::HostObject"),
    ("TileConstants", "crate::passes::TileConstants"),
];

/// Compiled shaders.
#[derive(Debug)]
pub struct Built {
    /// Rust source: one `static` a shader, the table `ALL` of all of them, the numbers of `inc/config.glsl`, and the checks of the
    /// host structs. It takes in
    /// `<name>.spv` from its own folder for each.
    pub rust: String,
    /// Name and SPIR-V of each, sorted by name.
    pub modules: Vec<(String, Vec<u32>)>,
}

/// Compiles every `<pass>.<stage>.glsl` of the folder `glsl`, once for each of its permutations. `macros` are defined in every
/// shader.
///
/// # Errors
///
/// All that is wrong with any shader, each as `path:line: error: …` where the compiler knows a line.
pub fn build(glsl: &Path, host_structs: &[HostStruct], macros: &[&str]) -> Result<Built, Vec<String>> {
    let sources = find_shaders(glsl)?;
    let compiler = Compiler::new(glsl, macros).map_err(|message| vec![message])?;
    let shared: Vec<&str> = host_structs.iter().map(|(glsl_name, _)| *glsl_name).collect();
    let mut errors = Vec::new();
    let mut jobs = Vec::new();
    for (file, path) in &sources {
        match compile::read_text(path) {
            Ok(source) => {
                let all = permutations::permutations(&source).into_iter().enumerate();
                jobs.extend(all.map(|(number, words)| Job { file, path, number, words }));
            }
            Err(problem) => errors.push(format!("{}: error: {problem}", path.display())),
        }
    }
    let mut shaders: Vec<(String, Vec<u32>)> = Vec::new();
    let mut layouts = BTreeMap::new();
    let mut failed = BTreeSet::new();
    // The permutations of a file mostly fail alike: the others wait for the first of each.
    let (first, others): (Vec<_>, Vec<_>) = jobs.into_iter().partition(|job| job.number == 0);
    for jobs in [first, others] {
        if !errors.is_empty() {
            break;
        }
        for (job, result) in jobs.iter().zip(in_parallel(&jobs, |job| job.compiled(&compiler, &shared))) {
            match result {
                Ok((spirv, found)) => {
                    let name = job.name();
                    for layout in found {
                        errors.extend(layout::merge(&mut layouts, &name, layout).err());
                    }
                    shaders.push((name, spirv));
                }
                Err(message) => {
                    if failed.insert(job.file) {
                        errors.push(message);
                    }
                }
            }
        }
    }
    shaders.sort();
    // A struct may be missing only because its shader failed; then that failure is the thing to read.
    if errors.is_empty() {
        for (glsl_name, _) in host_structs.iter().filter(|(name, _)| !layouts.contains_key(*name)) {
            let folder = glsl.display();
            errors.push(format!("{folder}: error: no shader has a struct `{glsl_name}` in a buffer"));
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let names: Vec<&str> = shaders.iter().map(|(name, _)| name.as_str()).collect();
    let config = config::module(glsl).map_err(|error| vec![error])?;
    let rust = table::shaders(&names) + &config + &table::checks(host_structs, &layouts);
    Ok(Built { rust, modules: shaders })
}

/// A permutation to compile.
struct Job<'a> {
    file: &'a str,
    path: &'a Path,
    number: usize,
    words: Vec<String>,
}

impl Job<'_> {
    fn name(&self) -> String {
        permutations::name(self.file, &self.words)
    }

    /// Its SPIR-V and, of a file's first, those of the structs `shared` that it has: they are the same in all of its permutations.
    fn compiled(
        &self,
        compiler: &Compiler,
        shared: &[&str],
    ) -> Result<(Vec<u32>, Vec<StructLayout>), String> {
        let of_file = |problem: String| format!("{}: error: {problem}", self.path.display());
        let mut spirv = compiler.spirv(self.path, &self.words, Optimize::Performance)?;
        unroll::ask_the_driver(&mut spirv, &self.words).map_err(of_file)?;
        // Both splat passes must place a splat alike, to the last bit. Fragments say `precise` where they need it.
        if !self.file.ends_with(".frag") {
            spirv = exact::exact(&spirv).map_err(of_file)?;
        }
        if self.number > 0 {
            return Ok((spirv, Vec::new()));
        }
        // The optimizer strips names, so that the struct members are read from a second, unoptimized copy.
        let named = compiler.spirv(self.path, &self.words, Optimize::Off)?;
        Ok((spirv, struct_layouts(&named, shared).map_err(of_file)?))
    }
}

/// What `work` makes of each job, in their order, by as many threads as cargo may use, or the machine has processors.
fn in_parallel<J: Sync, R: Send>(jobs: &[J], work: impl Fn(&J) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let some_of_all = || {
        let mut done = Vec::new();
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(job) = jobs.get(number) else { return done };
            done.push((number, work(job)));
        }
    };
    let asked = env::var("NUM_JOBS").ok().and_then(|number| number.parse().ok());
    let threads = asked.unwrap_or_else(|| thread::available_parallelism().map_or(1, NonZero::get));
    let threads = threads.clamp(1, jobs.len().max(1));
    let mut done: Vec<(usize, R)> = thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|_| scope.spawn(some_of_all)).collect();
        let results = running.into_iter().map(|thread| thread.join());
        results.flat_map(|done| done.unwrap_or_else(|panic| panic::resume_unwind(panic))).collect()
    });
    done.sort_by_key(|(number, _)| *number);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Every file and folder below `folder`, itself included: what has to be compiled again when it changes.
pub fn files_and_folders(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = vec![folder.to_owned()];
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_dir() {
            found.extend(files_and_folders(&entry.path())?);
        } else {
            found.push(entry.path());
        }
    }
    found.sort();
    Ok(found)
}

/// The shaders right in `glsl`: name without `.glsl`, and path; sorted by name. Its folders hold only includes.
fn find_shaders(glsl: &Path) -> Result<Vec<(String, PathBuf)>, Vec<String>> {
    let unreadable = |e: io::Error| vec![format!("{}: error: cannot list: {e}", glsl.display())];
    let mut shaders = Vec::new();
    let mut errors = Vec::new();
    for entry in fs::read_dir(glsl).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let file_name = path.file_name().unwrap_or_default().to_string_lossy();
        // Hidden files are an editor's.
        if path.is_dir() || file_name.starts_with('.') {
            continue;
        }
        let name = file_name.strip_suffix(".glsl").unwrap_or_default();
        let pass = name.rsplit_once('.').map_or("", |(pass, _)| pass);
        // The name becomes an identifier of Rust.
        let well_named = pass.starts_with(|c: char| c.is_ascii_lowercase())
            && pass.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
        if well_named && compile::stage(name).is_some() {
            shaders.push((name.to_owned(), path));
        } else {
            errors.push(format!(
                "{}: error: a shader is named <pass>.<vert|frag|comp>.glsl, in small letters, digits and `_`; \
                 other files belong in a folder",
                path.display()
            ));
        }
    }
    shaders.sort();
    if errors.is_empty() { Ok(shaders) } else { Err(errors) }
}
