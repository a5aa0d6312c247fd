//! A part of the page before it is HTML.

use surfel::{
    Error, Result,
    report::{Grid, bench::Machine},
    save,
};

use super::command_line::CommandLine;

/// A part of the page: an entry of the table of contents.
#[derive(Default)]
pub struct Part {
    /// Its name in links and in the JSON.
    pub id: &'static str,
    /// Its heading.
    pub title: &'static str,
    /// Its conclusion in a sentence or two: stands in the summary, too.
    pub finding: String,
    /// Its contents, in order.
    pub blocks: Vec<Block>,
    /// The command lines that give the same.
    pub commands: Vec<CommandLine>,
    /// The reasons to doubt its times, a sentence each.
    pub flags: Vec<String>,
    /// The machine while it was timed.
    pub machine: Option<Machine>,
    /// All its figures, as the JSON of its subcommand has them.
    pub data: serde_json::Value,
}

impl Part {
    /// Puts another part's contents, commands and doubts behind its own; answers with the other's figures.
    pub fn go_on_with(&mut self, other: Self) -> serde_json::Value {
        self.blocks.extend(other.blocks);
        self.commands.extend(other.commands);
        self.flags.extend(other.flags);
        other.data
    }
}

/// Something to see. In all texts, what is between backticks is code.
pub enum Block {
    /// A heading within the part.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// Sentences, a line each.
    List(Vec<String>),
    /// Sentences, and whether they are true.
    Claims(Vec<(Option<bool>, String)>),
    /// A table, and which of its rows stand out.
    Table(Grid, Vec<usize>),
    /// A plot.
    Plot {
        /// SVG.
        svg: String,
        /// The text for those who can't see it.
        alt: String,
        /// A sentence on what one sees and what follows.
        caption: String,
    },
    /// Pictures side by side.
    Pictures {
        /// In a row, where there is room.
        columns: usize,
        /// Row by row.
        panels: Vec<Panel>,
        /// A sentence on what one sees and what follows.
        caption: String,
    },
}

/// A picture with what it shows.
pub struct Panel {
    /// Its name.
    pub name: String,
    /// A remark; may be empty.
    pub caption: String,
    /// The text for those who can't see it.
    pub alt: String,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// The file.
    pub png: Vec<u8>,
}

impl Panel {
    /// A panel of opaque sRGB bytes. Its alternative text is made of `about` and the name.
    pub fn new(
        name: impl Into<String>,
        caption: impl Into<String>,
        about: &str,
        size_px: [u32; 2],
        pixels: &[[u8; 3]],
    ) -> Result<Self> {
        let (name, caption) = (name.into(), caption.into());
        let png = save::png_bytes(size_px, 3, pixels.as_flattened())?;
        Ok(Self { alt: format!("{about}: {name}"), name, caption, size_px, png })
    }
}

impl Part {
    /// One that could not be gathered.
    pub fn missing(error: &Error) -> Self {
        let finding = format!("Not on this page: {error}");
        Self { flags: vec![finding.clone()], finding, ..Self::default() }
    }
}
