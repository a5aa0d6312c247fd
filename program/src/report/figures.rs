//! The papers' figures, as this device draws them.

use surfel::{Error, Result, report::Plot};

use super::{
    part::{Block, Panel, Part},
    session::Session,
};
use crate::figure::{self, Drawing, FigureArguments, Sheet};

/// Figures by their names, with what one sees and what follows.
const FIGURES: [(&str, &str); 10] = [
    (
        "g1",
        "Where a splat is magnified all filters agree, but for a trace. Where it is far below a pixel, no filter leaves it so \
         thin that it slips between the pixel centers. Where it is both, in the last row, the maximum is as thin as no filter; \
         tangent adjustment has nearly the footprint of full EWA.",
    ),
    (
        "g3",
        "Toward the horizon fields become finer than pixels and should fade to gray. No filter shows patterns that are not on \
         the board; EWA and tangent adjustment fade; the maximum stays ragged where splats are wider than pixels but not \
         higher.",
    ),
    (
        "g4",
        "Close up, with single pixels visible: the edges are stepped and speckled under the maximum, and smooth under tangent \
         adjustment and full EWA.",
    ),
    (
        "g5",
        "Where polygons end and splats begin there is a seam: splats as large as the triangles blur what these show sharp. The \
         sum of the splats' weights falls from 1 to 0 beyond the seam and fades one into the other. Without splats on the \
         very edges it falls unevenly, and parts of the seam stay.",
    ),
    (
        "g6",
        "Six layers are all that this scene has. With three, the balls in the last row are lost where three are behind each \
         other; blended into the third layer they are seen again. One layer of their mean opacity stands for up to four \
         surfaces, so that the picture stays lighter than it should be.",
    ),
    (
        "slides",
        "One exact layer and one that blends all that is behind it show what is in the glass, less crisp than complete depth \
         peeling; with two exact layers the difference is small.",
    ),
    (
        "p9",
        "Gaussian kernels of several widths. A narrow one keeps details and leaves gaps between the weights of neighbors, a wide \
         one blurs.",
    ),
    (
        "p10",
        "Kernels with a plateau: flat where the splat is surely the surface, falling where neighbors take over. They blur less \
         than a Gaussian of the same support.",
    ),
    (
        "p17",
        "What splats add up to is uneven wherever they lie unevenly. Divided by the sum of the weights it is the surface's own color; \
         the paper does that by a texture, here it is a division a pixel.",
    ),
    (
        "p20",
        "Splats that spread by less than a tolerance on the screen are drawn as one, which looks alike as long as the tolerance is near a \
         pixel. How many are left depends on how densely the model lies there.",
    ),
];

/// Gathers the part.
pub fn gather(session: &mut Session<'_>) -> Result<Part> {
    let mut part = Part {
        finding: "Everything shown was drawn by this device, curves included: they are weights that it has written. G: \
                  Guennebaud, Barthe, Paulin 2006; P: Pajarola, Sainz, Guidotti 2003."
            .to_owned(),
        ..Part::default()
    };
    for (name, caption) in FIGURES {
        let line = session.arguments.figure(name);
        let arguments: FigureArguments = line.arguments()?;
        let figure = arguments.name.ok_or_else(|| Error::option("NAME", "expected a figure"))?;
        match figure::draw(session.headless, session.bars, &arguments, figure)? {
            Drawing::Sheet(sheet) => sheet_blocks(&mut part, &sheet, caption)?,
            Drawing::Plot(plot) => plot_blocks(&mut part, &plot, arguments.size_px(figure)?, caption)?,
        }
        part.commands.push(line);
    }
    Ok(part)
}

fn sheet_blocks(part: &mut Part, sheet: &Sheet, caption: &str) -> Result<()> {
    part.blocks.push(Block::Heading(sheet.title.clone()));
    let rows: Vec<_> = match sheet.headings.is_empty() {
        true => vec![&sheet.panels[..]],
        false => sheet.panels.chunks(sheet.columns.max(1)).collect(),
    };
    let last = rows.len().saturating_sub(1);
    for (i, row) in rows.into_iter().enumerate() {
        if let Some(heading) = sheet.headings.get(i) {
            part.blocks.push(Block::Text(heading.clone()));
        }
        let panel = |panel: &figure::Panel| {
            let about = match sheet.headings.get(i) {
                Some(heading) => format!("{}, {heading}", sheet.title),
                None => sheet.title.clone(),
            };
            let picture = &panel.picture;
            Panel::new(&panel.name, &panel.caption, &about, picture.size_px, &picture.pixels)
        };
        part.blocks.push(Block::Pictures {
            columns: sheet.columns,
            panels: row.iter().map(panel).collect::<Result<_>>()?,
            caption: if i == last { caption.to_owned() } else { String::new() },
        });
    }
    part.blocks.push(Block::List(sheet.notes.clone()));
    Ok(())
}

fn plot_blocks(part: &mut Part, plot: &Plot, size_px: [u32; 2], caption: &str) -> Result<()> {
    let title = plot.title.first().cloned().unwrap_or_default();
    part.blocks.push(Block::Heading(title.clone()));
    let names: Vec<&str> = plot.names().collect();
    let axes = plot
        .charts
        .first()
        .map_or_else(String::new, |chart| format!("{} over {}", chart.y.name, chart.x.name));
    part.blocks.push(Block::Plot {
        svg: plot.svg(size_px)?,
        alt: format!("{title}: {axes}, curves for {}", names.join("; ")),
        caption: caption.to_owned(),
    });
    Ok(())
}
