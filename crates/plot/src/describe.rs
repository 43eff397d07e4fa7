//! The asymptotic behaviour of a motion, on one page: time series, phase plane, impacts with region and h-sets, and itinerary.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::chaos::State;
use impact_pair::json::{DescriptionDocument, FateName};
use impact_pair::mapping::Mapping;
use impact_pair::orbit::{Orbit, Progress, Settings};
use impact_pair::pair::Wall;
use impact_pair::units::Units;
use impact_pair::watch::Unwatched;
use impact_pair_answers::describe::Description;
use plotters::prelude::*;

use crate::chaos::section;
use crate::orbit::{Frame, Panel, Recorder, Style, Trace, explain, panel, title};
use crate::picture::{self, Axis, BLUE, Canvas, Drawn, GREEN, GREY, LegendSymbol, Look, Plane, SCALE, SKY};
use crate::picture::{VERMILION, greek, legend, program, typeset_text};
use crate::sweep::value;

/// The size of a panel in pixels of the picture, and the margin of the page.
const PANEL_SIZE: (i32, i32) = (600, 420);
const MARGIN: i32 = 16 * SCALE;
/// Forcing periods of the time series, and of the phase plane.
const CYCLES: u32 = 8;
const ORBIT_CYCLES: u32 = 40;
/// Impacts that are followed, and letters of the itinerary.
const IMPACTS: u64 = 2000;
const LETTERS: usize = 60;
/// Room on the right of axes.
const RIGHT_MARGIN: i32 = 38 * SCALE;
/// The mappings, from the lowest row up.
const MAPPINGS: [Mapping; 4] = [Mapping::P4, Mapping::P3, Mapping::P2, Mapping::P1];
const NAMES: [&str; 4] = ["P4 L→L", "P3 R→R", "P2 L→R", "P1 R→L"];

/// The part of the orbit that is drawn.
struct Followed {
    trace: Trace,
    /// The mapping that ends at each impact.
    mappings: Vec<Option<Mapping>>,
}

/// The page of a description, as SVG; `document` is the description's JSON.
///
/// # Errors
/// Returns an error if the picture cannot be drawn.
pub fn describe(scene: &Scene, found: &Description, document: &DescriptionDocument, look: &Look) -> Result<String> {
    let followed = follow(scene)?;
    let Followed { trace, .. } = &followed;
    let settled = document.fate.from.filter(|_| document.fate.kind == FateName::Attracted);
    let settled = settled.map_or(0, |from| from as usize);
    // A transient that fills the picture is drawn like the rest.
    let transient = if settled < trace.crossings.len() / 2 { settled } else { 0 };
    let style = Style { is_certified: true, transient };
    let planes =
        if found.region().is_some() { &[Panel::PhasePlane][..] } else { &[Panel::PhasePlane, Panel::SwitchPlane] };
    let width = look.size((2 * PANEL_SIZE.0 as u32, 0)).0;
    let drawn = |height: u32| {
        let mut top = 0;
        let svg = picture::svg((width, height), SCALE, |root| {
            top = head(scene, (found, document), (root, look))?;
            top += explain((trace, planes, style), (root, top, MARGIN))?;
            let (_, below) = root.split_vertically(top + MARGIN / 2);
            let areas = below.split_evenly((2, 2));
            for (letter, kind, area) in [('a', Panel::Displacement, &areas[0]), ('b', Panel::PhasePlane, &areas[1])] {
                let cycles = if kind.is_of_time() { CYCLES } else { ORBIT_CYCLES };
                panel(&Frame::new(kind, trace, cycles).lettered(letter), None, style, (root, area))?;
            }
            impacts(scene, (found, &followed, style), (&areas[2], root))?;
            itinerary(&followed.mappings, style, (&areas[3], root))
        })?;
        Ok::<_, anyhow::Error>((svg, top))
    };
    // The first drawing determines the height of the text.
    let panels = 2 * PANEL_SIZE.1 as u32;
    let (_, top) = drawn(2 * panels)?;
    let own = (top + MARGIN / 2) as u32 / SCALE as u32 + panels;
    Ok(drawn(look.size((width, own)).1)?.0)
}

/// Follows the orbit, certified.
fn follow(scene: &Scene) -> Result<Followed> {
    let settings = Settings { impacts: Some(IMPACTS), ..Settings::default() };
    let mut orbit = Orbit::of(scene, settings.clone())?;
    let mut recorder = Recorder::new(&orbit, ORBIT_CYCLES);
    let mut mappings = Vec::new();
    let _ = orbit.follow(&Unwatched, |orbit, step| {
        recorder.record(orbit, &step);
        if let Progress::Impact(impact) = &step {
            mappings.push(impact.mapping);
        }
        ControlFlow::<()>::Continue(())
    });
    let trace = recorder.finish(&orbit, &settings, mappings.len() as u64);
    Ok(Followed { trace, mappings })
}

/// Draws title, scene, fate and the legend of this page alone; returns their height.
fn head(
    scene: &Scene,
    (found, document): (&Description, &DescriptionDocument),
    (root, look): (&Canvas<'_>, &Look),
) -> Result<i32, Box<dyn std::error::Error>> {
    let lines = impact_pair_answers::describe::lines(document);
    let shown = lines.iter().filter(|(label, _)| ["fate", "exponent", "entropy"].contains(label));
    let shown = shown.map(|(label, text)| typeset_text(&format!("{label}: {text}")).replace(" -", " −"));
    let data = greek(&format!("{}; {}", scene.pair().in_words(), scene.start().in_words()));
    let last = format!("shown from the start on: (a) {CYCLES} forcing periods; (b) {ORBIT_CYCLES}; {}", program());
    let lines: Vec<String> = [data].into_iter().chain(shown).chain([last]).collect();
    let top = picture::caption(root, look, scene.title().unwrap_or("The motion"), &lines)?;
    let Some(region) = found.region() else { return Ok(top) };
    let mut entries = vec![
        (LegendSymbol::Dot(BLACK), "(c) impacts of the certified orbit".to_owned()),
        (LegendSymbol::Cell(SKY), format!("(c) trapping region of {} boxes", region.boxes())),
    ];
    if found.horseshoe().is_some() {
        entries.push((LegendSymbol::Outline(VERMILION), "(c) h-sets of the horseshoe".to_owned()));
    }
    let walls = [(BLUE, "(d) impact on the left wall"), (GREEN, "(d) impact on the right wall")];
    entries.extend(walls.map(|(colour, name)| (LegendSymbol::Cell(colour), name.to_owned())));
    Ok(top + legend(root, top, &entries)?)
}

/// Draws the impacts: mirrored to the left wall with the region and the h-sets, if there is a region, else on both walls.
fn impacts(
    scene: &Scene,
    (found, followed, style): (&Description, &Followed, Style),
    (area, root): (&Canvas<'_>, &Canvas<'_>),
) -> Drawn {
    let trace = &followed.trace;
    let harmonic = scene.pair().excitation().only();
    let (Some(region), Some(harmonic)) = (found.region(), harmonic) else {
        let frame = Frame::new(Panel::SwitchPlane, trace, CYCLES).lettered('c');
        return panel(&frame, None, style, (root, area)).map(|_| ());
    };
    let fastest = Units::amplitudes(harmonic)?.map(value).velocity;
    let mirrored = trace.crossings.iter().map(|crossing| -> State {
        let lead = if crossing.wall == Wall::Right { PI } else { 0.0 };
        [((crossing.phase.middle + lead) / TAU).rem_euclid(1.0), crossing.velocity.middle.abs() / fastest]
    });
    let states: Vec<State> = mirrored.collect();
    let below = title(area, "(c)  impacts, mirrored to the left wall")?;
    section(region, found.horseshoe(), &states, (&below, root))
}

/// Draws the mappings of the first impacts, one row for each mapping, coloured by the wall of the next impact.
fn itinerary(mappings: &[Option<Mapping>], style: Style, (area, root): (&Canvas<'_>, &Canvas<'_>)) -> Drawn {
    let below = title(area, "(d)  itinerary")?;
    let shown = mappings.len().min(LETTERS);
    let axes = [Axis::over(0.0, shown.max(1) as f64 + 1.0), Axis::named(&NAMES)];
    let plane = Plane::draw(&below, axes, ["number of the impact", ""], RIGHT_MARGIN)?;
    let row = |mapping: &Mapping| MAPPINGS.iter().position(|other| other == mapping);
    let places = mappings[..shown].iter().enumerate().filter_map(|(i, mapping)| {
        let mapping = mapping.as_ref()?;
        Some(((i + 1) as f64, row(mapping)? as f64, style.impact(mapping.walls().1, i)))
    });
    let places: Vec<(f64, f64, RGBColor)> = places.collect();
    let line = places.iter().map(|&(x, y, _)| plane.pixel([x, y])).collect::<Vec<_>>();
    root.draw(&PathElement::new(line, GREY.stroke_width(SCALE as u32)))?;
    for (x, y, colour) in places {
        let corners = [plane.pixel([x - 0.4, y + 0.22]), plane.pixel([x + 0.4, y - 0.22])];
        root.draw(&Rectangle::new(corners, colour.filled()))?;
    }
    Ok(())
}
