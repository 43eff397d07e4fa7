//! Light and dark: the same drawing with its lightnesses reversed.

/// The background of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Theme {
    /// Dark lines on white, for paper
    #[default]
    Light,
    /// Light lines on a dark ground, for screens
    Dark,
}

/// Lightness of the dark ground, and of the ink that is black in the light theme.
const GROUND_LIGHTNESS: f64 = 0.07;
const INK_LIGHTNESS: f64 = 0.92;

impl Theme {
    /// Converts a picture that was drawn in the light theme.
    pub fn of(self, svg: &str) -> String {
        match self {
            Self::Light => svg.to_owned(),
            Self::Dark => darkened(svg),
        }
    }
}

/// The picture with every colour attribute `"#RRGGBB"` replaced; texts have no unescaped quotes, so none is changed.
fn darkened(svg: &str) -> String {
    let mut parts = svg.split("\"#");
    let mut dark = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        dark.push_str("\"#");
        match part.get(..6).and_then(|digits| u32::from_str_radix(digits, 16).ok()) {
            Some(colour) => {
                let [_, rgb @ ..] = colour.to_be_bytes();
                let [red, green, blue] = turned(rgb);
                dark.push_str(&format!("{red:02X}{green:02X}{blue:02X}{}", &part[6..]));
            }
            None => dark.push_str(part),
        }
    }
    dark
}

/// The colour of the same hue and, where possible, the same chroma, with the lightness reversed.
fn turned(rgb: [u8; 3]) -> [u8; 3] {
    let parts = rgb.map(|part| f64::from(part) / 255.0);
    let (low, high) = parts.iter().fold((1.0f64, 0.0f64), |(low, high), &part| (low.min(part), high.max(part)));
    let lightness = 0.5 * (low + high);
    let dark = INK_LIGHTNESS - lightness * (INK_LIGHTNESS - GROUND_LIGHTNESS);
    let room = |lightness: f64| 1.0 - (2.0 * lightness - 1.0).abs();
    let saturation = if high > low { (high - low) / room(lightness) } else { 0.0 };
    let scale = if high > low { saturation * room(dark) / (high - low) } else { 0.0 };
    parts.map(|part| ((dark + (part - lightness) * scale).clamp(0.0, 1.0) * 255.0).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_becomes_the_background_and_hues_stay() {
        let svg = "<rect fill=\"#FFFFFF\"/><path stroke=\"#000000\" d=\"M0 0\"/><text fill=\"#0072B2\">#000000</text>";
        let dark = Theme::Dark.of(svg);
        assert!(dark.starts_with("<rect fill=\"#121212\"/><path stroke=\"#EBEBEB\""), "{dark}");
        assert!(dark.ends_with(">#000000</text>") && Theme::Light.of(svg) == svg);
        let [red, green, blue] = turned([0x00, 0x72, 0xb2]);
        assert!(red < green && green < blue && blue > 0xe0, "{red} {green} {blue}");
    }
}
