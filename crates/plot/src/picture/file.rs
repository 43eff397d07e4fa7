//! The file of a picture: SVG, or PNG of the same drawing.

use std::path::{Path, PathBuf};

use anyhow::Result;

/// Reads the name of a picture.
///
/// # Errors
/// When its ending is none that this build writes.
pub fn path(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("svg") => Ok(path),
        Some("png") if cfg!(feature = "png") => Ok(path),
        Some("png") => {
            Err("accepted is a name that ends in .svg; this build has no PNG: build with --features png".into())
        }
        _ => Err("accepted is a name that ends in .svg, or in .png in a build with --features png".into()),
    }
}

/// The bytes of the picture for a file of this name.
///
/// # Errors
/// When it cannot be turned into a PNG.
pub fn encoded(svg: String, path: &Path) -> Result<Vec<u8>> {
    match path.extension().is_some_and(|ending| ending == "png") {
        #[cfg(feature = "png")]
        true => png(&svg),
        _ => Ok(svg.into_bytes()),
    }
}

/// Pixels of a PNG for each one of the picture as it is shown.
#[cfg(feature = "png")]
const PIXELS: f32 = 2.0;

/// The SVG in pixels, its words in the font that this program carries.
#[cfg(feature = "png")]
fn png(svg: &str) -> Result<Vec<u8>> {
    use anyhow::Context;
    use resvg::tiny_skia::{Pixmap, Transform};
    use resvg::usvg::{Options, Tree};

    let mut options = Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    let tree = Tree::from_str(svg, &options)?;
    let size = tree.size().to_int_size().scale_by(PIXELS).context("no pixels")?;
    let mut pixels = Pixmap::new(size.width(), size.height()).context("too many pixels")?;
    resvg::render(&tree, Transform::from_scale(PIXELS, PIXELS), &mut pixels.as_mut());
    Ok(pixels.encode_png()?)
}
