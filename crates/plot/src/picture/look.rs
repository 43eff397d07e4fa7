//! The options of every picture: its colours, size and font, and whether it has a header.

use std::str::FromStr;

use super::Theme;

/// The font family of pictures.
const FONT_FAMILY: &str = "font-family=\"sans-serif\"";
/// The smallest size that has room for axes, and the largest side \[pixels\].
const MIN_SIZE: (u32, u32) = (400, 300);
const MAX_SIZE: u32 = 10_000;

/// How a picture looks, whatever it shows.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
pub struct Look {
    /// Colours of the picture
    #[cfg_attr(feature = "clap", arg(long, value_enum, default_value_t, value_name = "light|dark", requires = "plot"))]
    pub theme: Theme,
    /// Leave out title, parameters and certification above the picture, for a separate caption
    #[cfg_attr(feature = "clap", arg(long, requires = "plot"))]
    pub no_header: bool,
    /// Size of the picture in pixels, where letters are 12 to 14 pixels high [default: as much as it needs]
    #[cfg_attr(feature = "clap", arg(long, value_name = "WIDTHxHEIGHT", requires = "plot"))]
    pub size: Option<Size>,
    /// Family of the letters, such as "Times New Roman", from the fonts of the system [default: any without serifs]
    #[cfg_attr(feature = "clap", arg(long, value_name = "FAMILY", value_parser = family, requires = "plot"))]
    pub font: Option<String>,
}

/// A size of a picture \[pixels\].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Across.
    pub width: u32,
    /// Down.
    pub height: u32,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ends = text.split_once(['x', 'X', '×']);
        let read = ends.and_then(|(width, height)| Some((width.trim().parse().ok()?, height.trim().parse().ok()?)));
        match read {
            Some((width, height))
                if (MIN_SIZE.0..=MAX_SIZE).contains(&width) && (MIN_SIZE.1..=MAX_SIZE).contains(&height) =>
            {
                Ok(Self { width, height })
            }
            _ => {
                let (width, height) = MIN_SIZE;
                Err(format!(
                    "accepted are sizes in pixels from {width}x{height} to {MAX_SIZE}x{MAX_SIZE}, such as 600x450"
                ))
            }
        }
    }
}

/// Reads the name of a font family.
#[cfg(feature = "clap")]
fn family(text: &str) -> Result<String, String> {
    let is_name = !text.trim().is_empty() && text.chars().all(|c| c.is_alphanumeric() || " -_".contains(c));
    if is_name { Ok(text.trim().to_owned()) } else { Err("accepted is the name of a family, such as Arial".into()) }
}

impl Look {
    /// The requested size, or else `own`, the picture's usual size \[pixels\].
    pub fn size(&self, own: (u32, u32)) -> (u32, u32) {
        self.size.map_or(own, |size| (size.width, size.height))
    }

    /// Applies the requested colours and font to a picture drawn in the usual ones.
    pub fn of(&self, svg: &str) -> String {
        let svg = self.theme.of(svg);
        match &self.font {
            Some(font) => svg.replace(FONT_FAMILY, &format!("font-family=\"{font}, sans-serif\"")),
            None => svg,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn r35_sizes_are_read_and_others_refused() {
        assert_eq!("600x450".parse(), Ok(Size { width: 600, height: 450 }));
        for text in ["600", "600x", "ax3", "100x450", "600x20000", "-600x450", "600.5x450"] {
            assert!(text.parse::<Size>().unwrap_err().contains("from 400x300 to 10000x10000"), "{text}");
        }
    }

    #[test]
    fn r35_letters_are_of_the_requested_font_family() {
        let svg = format!("<text {FONT_FAMILY} font-size=\"48\">a</text>");
        assert_eq!(Look::default().of(&svg), svg);
        let look = Look { font: Some("Times New Roman".into()), ..Look::default() };
        assert_eq!(look.of(&svg), "<text font-family=\"Times New Roman, sans-serif\" font-size=\"48\">a</text>");
    }
}
