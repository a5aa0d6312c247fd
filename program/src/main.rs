//! The command-line program: one file or folder a subcommand, with its options and its manual;
//! what they share is in files of its own.

mod allocator;
mod arguments;
mod bench;
mod camera;
mod compare;
mod console;
mod convert;
mod described;
mod device;
mod drawing;
mod emptiness;
mod explain;
mod figure;
mod film;
mod hierarchies;
mod info;
mod inputs;
#[cfg(unix)]
mod interrupts;
mod json;
mod machine;
mod measure;
mod octrees;
mod oddities;
mod origin;
mod outputs;
mod parse;
mod part;
mod pick;
mod picture;
mod pictures;
mod ranks;
mod reference;
mod render;
mod report;
mod reports;
mod scene;
mod scene_file_keys;
mod selftest;
mod settings;
mod steps;
mod turns;
mod unused;
mod up;
mod usage;
mod view;

use std::process::ExitCode;

fn main() -> ExitCode {
    allocator::keep_freed_memory();
    if std::env::args_os().any(|argument| argument == "--validate" || argument == "selftest") {
        // SAFETY: first thing in `main`, there is no other thread yet.
        unsafe { surfel::vk::arm_validation_across_submits() };
    }
    #[cfg(unix)]
    interrupts::watch();
    let tell = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        // What a decoder of another crate stumbles over is told as an error of its file.
        if !surfel::load::runs_foreign_decoder() {
            tell(panic);
        }
    }));
    let arguments = match usage::parse() {
        Ok(arguments) => arguments,
        Err(exit) => return exit,
    };
    let done = arguments.command.run();
    allocator::tell_peak();
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            console::fail(&error.to_string());
            ExitCode::from(error.exit_code())
        }
    }
}
