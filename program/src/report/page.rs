//! The page as HTML: one file that loads nothing. All text is escaped.

use base64::{Engine as _, prelude::BASE64_STANDARD};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use surfel::report::Grid;

use super::{
    head::Head,
    part::{Block, Panel, Part},
};

const STYLE: &str = include_str!("style.css");

/// Nothing but what is in the page is ever loaded; a browser is told to see to that.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'";

/// The whole page.
pub fn html(head: &Head, parts: &[Part]) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                title { "surfel: " (head.title()) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                nav aria-label="Contents" {
                    a href="#top" { "surfel report" }
                    ol {
                        @for part in parts {
                            li { a href={ "#" (part.id) } { (part.title) @if !part.flags.is_empty() { " ⚠" } } }
                        }
                        li { a href="#repeat" { "How to repeat this" } }
                    }
                }
                main {
                    (header(head, parts))
                    @for part in parts { (section(part)) }
                    (repeat(head, parts))
                }
            }
        }
    };
    page.into_string()
}

/// The page's subject, its findings, and its doubts.
fn header(head: &Head, parts: &[Part]) -> Markup {
    let doubtful = parts.iter().any(|part| !part.flags.is_empty());
    html! {
        header id="top" {
            h1 { "surfel report" }
            p class="subtitle" { (head.title()) }
            aside class=(if doubtful { "trust doubt" } else { "trust" }) {
                h2 { "Can these figures be trusted?" }
                @if doubtful {
                    p { "Not all of them. Ratios within one table hold better than milliseconds: methods took turns." }
                    ul {
                        @for part in parts {
                            @for flag in &part.flags {
                                li { a href={ "#" (part.id) } { (part.title) } ": " (rich(flag)) }
                            }
                        }
                    }
                } @else {
                    p { "As far as this system tells, nothing speaks against them: no other work on the processor, no moving \
                         clock, no wide spread." }
                }
                @if head.is_processor {
                    p { "The device is the processor itself: times rank the methods for this driver, not for graphics cards. \
                         Errors differ by rounding only." }
                }
            }
            h2 { "What follows" }
            dl class="findings" {
                @for part in parts {
                    dt { a href={ "#" (part.id) } { (part.title) } }
                    dd { (rich(&part.finding)) }
                }
            }
            h2 { "What was measured" }
            dl class="facts" {
                @for (name, value) in head.facts() {
                    dt { (name) }
                    dd { (rich(&value)) }
                }
            }
        }
    }
}

fn section(part: &Part) -> Markup {
    html! {
        section id=(part.id) {
            h2 { (part.title) }
            p class="finding" { (rich(&part.finding)) }
            @if !part.flags.is_empty() {
                ul class="doubt" { @for flag in &part.flags { li { (rich(flag)) } } }
            }
            @for shown in &part.blocks { (block(shown)) }
            @if !part.commands.is_empty() {
                p class="repeat" { "The same again:" }
                pre { @for line in &part.commands { (line.to_string()) "\n" } }
            }
        }
    }
}

/// All command lines at one place.
fn repeat(head: &Head, parts: &[Part]) -> Markup {
    html! {
        section id="repeat" {
            h2 { "How to repeat this" }
            p { "The page:" }
            pre { (head.command) }
            p { "Its parts, each by itself; two runs differ in times and what is told of them, in nothing else:" }
            pre {
                @for part in parts {
                    @if !part.commands.is_empty() {
                        "# " (part.title) "\n"
                        @for line in &part.commands { (line.to_string()) "\n" }
                    }
                }
            }
            p { "All figures of this page are in " code { "report.json" } " beside it. Versions and settings are at the " a href="#top" { "top" } "." }
        }
    }
}

fn block(block: &Block) -> Markup {
    match block {
        Block::Heading(text) => html! { h3 { (rich(text)) } },
        Block::Text(text) => html! { p { (rich(text)) } },
        Block::List(lines) => html! { ul class="notes" { @for line in lines { li { (rich(line)) } } } },
        Block::Claims(claims) => html! {
            ul class="claims" { @for (holds, text) in claims { (claim(*holds, text)) } }
        },
        Block::Table(grid, marked) => table(grid, marked),
        Block::Plot { svg, alt, caption } => html! {
            figure class="plot" {
                (PreEscaped(labeled(svg, alt)))
                figcaption { (rich(caption)) }
            }
        },
        Block::Pictures { columns, panels, caption } => html! {
            figure {
                div class="pictures" style={ "--columns:" (columns) ";--narrow:" ((*columns).min(2)) } {
                    @for panel in panels { (picture(panel)) }
                }
                @if !caption.is_empty() { figcaption { (rich(caption)) } }
            }
        },
    }
}

fn claim(holds: Option<bool>, text: &str) -> Markup {
    let (class, sign) = match holds {
        Some(true) => ("holds", "✓ "),
        Some(false) => ("fails", "✗ "),
        None => ("unknown", "– "),
    };
    html! { li class=(class) { (sign) (rich(text)) } }
}

fn picture(panel: &Panel) -> Markup {
    let [width, height] = panel.size_px;
    let source = format!("data:image/png;base64,{}", BASE64_STANDARD.encode(&panel.png));
    html! {
        figure {
            img src=(source) width=(width) height=(height) alt=(panel.alt);
            figcaption {
                b { (panel.name) }
                @if !panel.caption.is_empty() { " " (rich(&panel.caption)) }
            }
        }
    }
}

/// A table; the first column names the row.
fn table(grid: &Grid, marked: &[usize]) -> Markup {
    html! {
        div class="table" role="region" aria-label=(grid.title) tabindex="0" {
            table {
                caption { (rich(&grid.title)) }
                thead { tr { @for name in &grid.head { th scope="col" { (name) } } } }
                tbody {
                    @for (i, row) in grid.rows.iter().enumerate() {
                        tr class=[marked.contains(&i).then_some("marked")] {
                            @for (column, cell) in row.iter().enumerate() {
                                @if column == 0 { th scope="row" { (cell) } } @else { td { (cell) } }
                            }
                        }
                    }
                }
            }
        }
        @if !grid.notes.is_empty() {
            ul class="notes" { @for note in &grid.notes { li { (rich(note)) } } }
        }
    }
}

/// Text in which what is between backticks is code.
fn rich(text: &str) -> Markup {
    html! {
        @for (i, piece) in text.split('`').enumerate() {
            @if i % 2 == 1 { code { (piece) } } @else { (piece) }
        }
    }
}

/// A plot that says what it is to those who can't see it.
fn labeled(svg: &str, alt: &str) -> String {
    let alt = html! { (alt) }.into_string();
    svg.replacen("<svg ", &format!("<svg role=\"img\" aria-label=\"{}\" ", alt.replace('"', "&quot;")), 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_name_their_rows_and_mark_some_and_escape_all() {
        let rows = [("<i>", 1), ("two", 2)];
        let grid = Grid::of("a `b` <c>", &rows).column("name", |row| row.0).column("x & y, ms", |row| row.1);
        let shown = table(&grid.grid(), &[1]).into_string();
        for expected in [
            "<caption>a <code>b</code> &lt;c&gt;</caption>",
            "<th scope=\"col\">x &amp; y, ms</th>",
            "<tr><th scope=\"row\">&lt;i&gt;</th><td>1</td></tr>",
            "<tr class=\"marked\"><th scope=\"row\">two</th>",
        ] {
            assert!(shown.contains(expected), "{expected} is not in {shown}");
        }
    }

    #[test]
    fn a_part_that_could_not_be_gathered_says_why() {
        let part = Part::missing(&surfel::Error::option("bench", "no <timestamps>"));
        let shown = section(&part).into_string();
        assert!(shown.contains("Not on this page: bench: no &lt;timestamps&gt;"), "{shown}");
    }

    #[test]
    fn a_plot_is_labeled_and_the_label_ends_nothing() {
        let svg = labeled("<svg width=\"1\"><svg /></svg>", "\"a\" < b");
        assert_eq!(svg, "<svg role=\"img\" aria-label=\"&quot;a&quot; &lt; b\" width=\"1\"><svg /></svg>");
    }
}
