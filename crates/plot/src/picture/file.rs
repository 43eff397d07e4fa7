//! The file of a picture: SVG, or PNG or PDF of the same drawing.

use std::path::{Path, PathBuf};

use anyhow::Result;

use super::Look;

/// The accepted endings of names in this build, in words.
const ENDINGS: &str = match (cfg!(feature = "png"), cfg!(feature = "pdf")) {
    (true, true) => "accepted is a name that ends in .svg, .png or .pdf",
    (true, false) => "accepted is a name that ends in .svg or .png, or in .pdf in a build with --features pdf",
    (false, true) => "accepted is a name that ends in .svg or .pdf, or in .png in a build with --features png",
    (false, false) => "accepted is a name that ends in .svg, or in .png or .pdf in a build with --features png,pdf",
};

/// Reads the name of a picture.
///
/// # Errors
/// Returns an error if the ending is not a format that this build writes.
pub fn path(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match ending(&path).as_str() {
        "svg" => Ok(path),
        "png" if cfg!(feature = "png") => Ok(path),
        "pdf" if cfg!(feature = "pdf") => Ok(path),
        _ => Err(ENDINGS.into()),
    }
}

/// The ending of a name, in small letters.
fn ending(path: &Path) -> String {
    path.extension().map_or(String::new(), |ending| ending.to_string_lossy().to_ascii_lowercase())
}

/// The bytes of a picture for a file of this name, in this look.
///
/// # Errors
/// Returns an error if the picture cannot be converted to PNG or PDF, or the system lacks the font.
pub fn encoded(svg: &str, look: &Look, path: &Path) -> Result<Vec<u8>> {
    let svg = look.of(svg);
    match ending(path).as_str() {
        #[cfg(feature = "png")]
        "png" => png(&svg, look),
        #[cfg(feature = "pdf")]
        "pdf" => pdf(&svg, look),
        _ => Ok(svg.into_bytes()),
    }
}

/// The SVG with its text in the fonts that this program carries, or in the requested font family of the system.
#[cfg(any(feature = "png", feature = "pdf"))]
fn tree(svg: &str, look: &Look) -> Result<usvg::Tree> {
    let mut options = usvg::Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.load_font_data(dejavu::sans::oblique().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    if let Some(font) = &look.font {
        fonts.load_system_fonts();
        let is_there = fonts.faces().any(|face| face.families.iter().any(|(name, _)| name == font));
        anyhow::ensure!(is_there, "--font is {font}, but accepted is a family of the system's fonts");
    }
    Ok(usvg::Tree::from_str(svg, &options)?)
}

/// Pixels of a PNG for each pixel of the picture.
#[cfg(feature = "png")]
const PIXELS: f32 = 2.0;

/// The SVG in pixels.
#[cfg(feature = "png")]
fn png(svg: &str, look: &Look) -> Result<Vec<u8>> {
    use anyhow::Context;
    use resvg::tiny_skia::{Pixmap, Transform};

    let tree = tree(svg, look)?;
    let size = tree.size().to_int_size().scale_by(PIXELS).context("no pixels")?;
    let mut pixels = Pixmap::new(size.width(), size.height()).context("too many pixels")?;
    resvg::render(&tree, Transform::from_scale(PIXELS, PIXELS), &mut pixels.as_mut());
    Ok(pixels.encode_png()?)
}

/// The SVG on a page of its size; its text is text in fonts that the file holds.
#[cfg(feature = "pdf")]
fn pdf(svg: &str, look: &Look) -> Result<Vec<u8>> {
    use anyhow::anyhow;
    use svg2pdf::{ConversionOptions, PageOptions, to_pdf};

    to_pdf(&tree(svg, look)?, ConversionOptions::default(), PageOptions::default()).map_err(|error| anyhow!("{error}"))
}
