//! The command-line program: one file a subcommand; what they share is in files of its own.

mod allocator;
mod arguments;
mod bench;
mod cache;
mod camera;
mod compare;
mod console;
mod convert;
mod counts;
mod device;
mod explain;
mod figure;
mod info;
mod json;
mod machine;
mod measure;
mod outputs;
mod parse;
mod picture_arguments;
mod pictures;
mod reference;
mod render;
mod report;
mod reports;
mod scene;
mod scene_file_keys;
mod selftest;
mod steps;
mod turns;
mod usage;
mod validation;

use std::process::ExitCode;

use arguments::{Arguments, Command};

fn main() -> ExitCode {
    allocator::keep_freed_memory();
    if std::env::args_os().any(|argument| argument == "--validate" || argument == "selftest") {
        // SAFETY: first thing in `main`, there is no other thread yet.
        unsafe { surfel::vk::arm_validation_across_submits() };
    }
    let arguments: Arguments = match usage::parse() {
        Ok(arguments) => arguments,
        Err(exit) => return exit,
    };
    let done = match &arguments.command {
        Command::Render(arguments) => render::run(arguments),
        Command::Reference(arguments) => reference::run(arguments),
        Command::Compare(arguments) => compare::run(arguments),
        Command::Convert(arguments) => convert::run(arguments),
        Command::Figure(arguments) => figure::run(arguments),
        Command::Bench(arguments) => bench::run(arguments),
        Command::Selftest(arguments) => selftest::run(arguments),
        Command::Report(arguments) => report::run(arguments),
        Command::Info(arguments) => info::run(arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            console::fail(&error.to_string());
            ExitCode::from(error.exit_code())
        }
    }
}
