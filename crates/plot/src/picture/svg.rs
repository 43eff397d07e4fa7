//! The canvas: drawings by plotters, and elements of this crate, as SVG.

use std::convert::Infallible;
use std::fmt::Write;

use plotters::element::{Drawable, PointCollection};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingErrorKind, FontStyle, FontTransform,
};

use super::math;

/// Ratio of the line height to the font size.
const LEADING: f64 = 1.24;

/// A canvas that becomes SVG text.
pub struct Svg<'t> {
    text: &'t mut String,
    size: (u32, u32),
}

type Done = Result<(), DrawingErrorKind<Infallible>>;

impl<'t> Svg<'t> {
    /// The backend of a picture of this size in pixels, with `scale` pixels of the canvas for each pixel of the picture.
    pub fn new(text: &'t mut String, (width, height): (u32, u32), scale: u32) -> Self {
        let size = (width * scale, height * scale);
        *text = format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\" xml:space=\"preserve\">\n",
            size.0, size.1
        );
        Self { text, size }
    }

    fn write(&mut self, element: &str) -> Done {
        self.text.push_str(element);
        self.text.push('\n');
        Ok(())
    }
}

/// A colour and its opacity, as attributes; `None` for a transparent colour.
fn paint(attribute: &str, colour: BackendColor) -> Option<String> {
    let (red, green, blue) = colour.rgb;
    let opacity = if colour.alpha < 1.0 { format!(" {attribute}-opacity=\"{}\"", colour.alpha) } else { String::new() };
    (colour.alpha > 0.0).then(|| format!("{attribute}=\"#{red:02X}{green:02X}{blue:02X}\"{opacity}"))
}

/// The paint of a filled, or else outlined, shape.
fn shape(style: &impl BackendStyle, fill: bool) -> Option<String> {
    if fill {
        return paint("fill", style.color());
    }
    paint("stroke", style.color())
        .map(|stroke| format!("fill=\"none\" {stroke} stroke-width=\"{}\"", style.stroke_width()))
}

/// The corners of a line as the data of a path.
fn corners(path: impl IntoIterator<Item = BackendCoord>) -> String {
    let mut data = String::new();
    for (i, (x, y)) in path.into_iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = write!(data, "{}{x} {y}", if i == 0 { "M" } else { "L" });
    }
    data
}

impl DrawingBackend for Svg<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Done {
        Ok(())
    }

    fn present(&mut self) -> Done {
        self.write("</svg>")
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, colour: BackendColor) -> Done {
        let Some(fill) = paint("fill", colour) else { return Ok(()) };
        self.write(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"1\" height=\"1\" {fill}/>"))
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Done {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(&mut self, (x, y): BackendCoord, to: BackendCoord, style: &S, fill: bool) -> Done {
        let Some(paint) = shape(style, fill) else { return Ok(()) };
        let (width, height) = (to.0 - x, to.1 - y);
        self.write(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" {paint}/>"))
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Done {
        let Some(paint) = shape(style, false) else { return Ok(()) };
        self.write(&format!("<path {paint} d=\"{}\"/>", corners(path)))
    }

    fn draw_circle<S: BackendStyle>(&mut self, (x, y): BackendCoord, radius: u32, style: &S, fill: bool) -> Done {
        let Some(paint) = shape(style, fill) else { return Ok(()) };
        self.write(&format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" {paint}/>"))
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Done {
        let Some(paint) = shape(style, true) else { return Ok(()) };
        self.write(&format!("<path {paint} d=\"{}z\"/>", corners(path)))
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, (x, y): BackendCoord) -> Done {
        let Some(fill) = paint("fill", style.color()) else { return Ok(()) };
        let size = style.size() / LEADING;
        // Renderers differ in the middle and the end of a text of several runs, not in its start.
        let (anchor, before) = match (style.anchor().h_pos, math::runs_width(text, size)) {
            (HPos::Left, _) => ("start", 0.0),
            (HPos::Right, None) => ("end", 0.0),
            (HPos::Center, None) => ("middle", 0.0),
            (HPos::Right, Some(width)) => ("start", width),
            (HPos::Center, Some(width)) => ("start", 0.5 * width),
        };
        let left = (f64::from(x) - before).round();
        // From the baseline down, relative to the font size.
        let down: f64 = match style.anchor().v_pos {
            VPos::Top => 0.76,
            VPos::Center => 0.36,
            VPos::Bottom => -0.2,
        };
        let turned = match style.transform() {
            FontTransform::None => String::new(),
            FontTransform::Rotate90 => format!(" transform=\"rotate(90,{x},{y})\""),
            FontTransform::Rotate180 => format!(" transform=\"rotate(180,{x},{y})\""),
            FontTransform::Rotate270 => format!(" transform=\"rotate(270,{x},{y})\""),
        };
        let weight = if matches!(style.style(), FontStyle::Bold) { " font-weight=\"bold\"" } else { "" };
        self.write(&format!(
            "<text x=\"{left}\" y=\"{:.1}\" text-anchor=\"{anchor}\" font-family=\"{}\" font-size=\"{size:.1}\" {fill}{weight}{turned}>{}</text>",
            down.mul_add(size, f64::from(y)),
            style.family().as_str(),
            math::typeset(text, size)
        ))
    }
}

/// An SVG element in pixels of the canvas.
pub struct Element(pub String);

impl<'e> PointCollection<'e, BackendCoord> for &'e Element {
    type IntoIter = std::iter::Empty<BackendCoord>;
    type Point = BackendCoord;

    fn point_iter(self) -> Self::IntoIter {
        std::iter::empty()
    }
}

impl Drawable<Svg<'_>> for Element {
    fn draw<I: Iterator<Item = BackendCoord>>(&self, _: I, canvas: &mut Svg<'_>, _: (u32, u32)) -> Done {
        canvas.write(&self.0)
    }
}
