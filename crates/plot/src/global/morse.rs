//! The graph of components: each component above the components to which motions may lead.

use impact_pair::chaos::Global;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::{MAX_COMPONENTS, colour, name};
use crate::picture::{Canvas, Drawn, FONT, GREY, SCALE, words};

/// Radius of a node, and the room around the graph.
const RADIUS: i32 = 9 * SCALE;
const MARGIN: i32 = 30 * SCALE;
/// Length of the head of an arrow.
const ARROW_HEAD: f64 = 9.0 * SCALE as f64;

/// Draws the components, as many as there is room for, and arrows between components with no third component in between.
pub fn draw(found: &Global, area: &Canvas<'_>) -> Drawn {
    let count = found.components.len().min(MAX_COMPONENTS);
    let leads = |from: usize, to: usize| found.order.contains(&[from, to]);
    let arrows: Vec<[usize; 2]> = found
        .order
        .iter()
        .copied()
        .filter(|&[from, to]| from < count && to < count && from != to)
        .filter(|&[from, to]| !(0..count).any(|k| k != from && k != to && leads(from, k) && leads(k, to)))
        .collect();
    let places = places(&depths(count, &arrows), area);
    for &[from, to] in &arrows {
        arrow(area, places[from], places[to])?;
    }
    for (i, &at) in places.iter().enumerate() {
        let style = colour(found, i);
        if found.components[i].is_closed {
            area.draw(&Circle::new(at, RADIUS + 3 * SCALE, style.stroke_width(SCALE as u32)))?;
        }
        area.draw(&Circle::new(at, RADIUS, style.filled()))?;
        area.draw(&Text::new(name(found, i), (at.0 + 2 * RADIUS, at.1), words(FONT, &BLACK, HPos::Left)))?;
    }
    let rest = found.components.len() - count;
    let more = if rest > 0 { format!("and {rest} more; ") } else { String::new() };
    let said = format!("{more}with a ring: closed");
    let (_, height) = area.dim_in_pixel();
    area.draw(&Text::new(said, (MARGIN - RADIUS, height as i32 - MARGIN / 2), words(FONT, &GREY, HPos::Left)))?;
    Ok(())
}

/// For each component the length of the longest path of arrows to it. Arrows lead to components of
/// greater numbers, except for the arrows of the last component.
fn depths(count: usize, arrows: &[[usize; 2]]) -> Vec<usize> {
    let mut depths = vec![0; count];
    for _ in 0..count {
        for &[from, to] in arrows {
            depths[to] = depths[to].max((depths[from] + 1).min(count - 1));
        }
    }
    depths
}

/// Places in rows by depth.
fn places(depths: &[usize], area: &Canvas<'_>) -> Vec<(i32, i32)> {
    let (wide, high) = area.dim_in_pixel();
    let rows = depths.iter().max().map_or(1, |&most| most as i32 + 1);
    let step = (high as i32 - 4 * MARGIN) / rows.max(2);
    let place = |i: usize| {
        let own = |&k: &usize| depths[k] == depths[i];
        let (before, all) = ((0..i).filter(own).count() as i32, (0..depths.len()).filter(own).count() as i32);
        let x = MARGIN + before * (wide as i32 - 2 * MARGIN) / all;
        // Neighbours in a row are shifted, so that their names do not overlap.
        (x, MARGIN + depths[i] as i32 * step + before % 2 * 2 * RADIUS)
    };
    (0..depths.len()).map(place).collect()
}

/// A line from node to node, with a head.
fn arrow(area: &Canvas<'_>, from: (i32, i32), to: (i32, i32)) -> Drawn {
    let (dx, dy) = (f64::from(to.0 - from.0), f64::from(to.1 - from.1));
    let long = dx.hypot(dy).max(1.0);
    let (along, across) = ((dx / long, dy / long), (-dy / long, dx / long));
    let gap = f64::from(RADIUS + 4 * SCALE);
    let at = |back: f64, offset: f64| {
        let x = f64::from(to.0) - along.0 * (gap + back) + across.0 * offset;
        let y = f64::from(to.1) - along.1 * (gap + back) + across.1 * offset;
        (x as i32, y as i32)
    };
    area.draw(&PathElement::new([from, at(ARROW_HEAD, 0.0)], GREY.stroke_width(SCALE as u32 * 3 / 2)))?;
    area.draw(&Polygon::new(
        [at(0.0, 0.0), at(ARROW_HEAD, 0.4 * ARROW_HEAD), at(ARROW_HEAD, -0.4 * ARROW_HEAD)],
        GREY.filled(),
    ))?;
    Ok(())
}
