//! Points and cells of the plane.

use impact_pair::chaos::{Class, GlobalSettings};
use impact_pair::watch::Unwatched;

use super::tally::Shares;
use super::*;
use crate::grid::Head;
use crate::scenes::scene_of;

fn plane(axes: [&str; 2], cells: bool) -> Plane {
    Plane::new(axes.map(|axis| axis.parse().unwrap()).to_vec(), cells).unwrap()
}

/// The record of a point or tile; `None` if the watch stops it.
fn record(
    scene: &Scene,
    plane: &Plane,
    settings: &GlobalSettings,
    point: u64,
    watch: &dyn Watch,
) -> Option<AtlasRecord> {
    let atlas = Atlas::new(scene, plane.clone(), *settings, None);
    atlas.record(point, &plane.values(point).unwrap(), watch).unwrap()
}

/// Tiles, and the cells that each is cut into, cover the rectangle once: each of the smallest cells is in one of them.
#[test]
fn a20_cells_cover_the_rectangle_once() {
    for counts in [[2, 2], [3, 5], [8, 8], [13, 20], [2, 40]] {
        let [x, y] = counts;
        let plane = plane([&format!("gap=1..2:{x}"), &format!("restitution=0..0.5:{y}")], true);
        let mut cells: Vec<Rectangle> = (0..plane.points()).map(|point| plane.tile(point)).collect();
        let mut seen = std::collections::HashSet::new();
        while let Some(cell) = cells.pop() {
            let quarters = cell.quarters();
            assert!(quarters.is_empty() || quarters.iter().map(Rectangle::smallest).sum::<u64>() == cell.smallest());
            if quarters.is_empty() {
                assert!(cell.smallest() == 1 && seen.insert(cell.from), "{cell:?}");
            }
            cells.extend(quarters);
        }
        assert_eq!(seen.len() as u64, x * y);
    }
}

#[test]
fn the_ends_of_cells_are_exact_and_meet() {
    let plane = plane(["gap=0.1..0.4:3", "restitution=0..0.5:4"], true);
    let texts =
        |cell: &Rectangle| plane.intervals(cell).unwrap().into_iter().map(|(_, x)| x.text()).collect::<Vec<_>>();
    assert_eq!(texts(&Rectangle { from: [0, 0], to: [1, 2] }), ["[0.1, 0.2]", "[0, 0.25]"]);
    assert_eq!(texts(&Rectangle { from: [1, 2], to: [3, 4] }), ["[0.2, 0.4]", "[0.25, 0.5]"]);
    assert_eq!(plane.points(), 12);
}

#[test]
fn axes_that_span_no_plane_are_refused() {
    let refused = |axes: &[&str]| {
        let axes = axes.iter().map(|axis| axis.parse().unwrap()).collect();
        Plane::new(axes, false).unwrap_err().to_string()
    };
    assert!(refused(&["gap=1..2:3"]).contains("accepted are two axes"));
    assert!(refused(&["gap=1..2:3", "start.time=0..1:2"]).contains("the start is not used"));
    assert!(refused(&["gap=1..2:3", "gap=1..2:3"]).contains("two axes with different keys"));
}

/// A cell says what its points say, and a point within it can say no other class: cycles with rests at e = 0 (Theorem Z4), alpha from 2 on.
#[test]
fn a20_a_cell_holds_for_its_points() {
    let start = "time = 0, wall = \"left\", velocity = 0";
    let scene = scene_of("amplitude = 4, frequency = 1, phase = 0", "gap = 1, restitution = 0.05", start);
    let settings = GlobalSettings { boxes: 1 << 10, most: 20_000, ..GlobalSettings::default() };
    let axes = ["amplitude=4..4.01:2", "restitution=0.05..0.051:2"];
    let points = plane(axes, false);
    let cells = plane(axes, true);
    let at = |plane: &Plane, point| record(&scene, plane, &settings, point, &Unwatched).unwrap();
    let atlas = Atlas::new(&scene, cells.clone(), settings, None);
    for point in 0..4 {
        let (one, cell) = (at(&points, point), at(&cells, point));
        assert_eq!([one.class, cell.class], [Class::OneRestCycle; 2]);
        assert_eq!(Shares::of(&cells, &cell), Shares { all: 1, decided: 1, ..Shares::default() });
        let head = atlas.head();
        assert_eq!(head.grid().unwrap().points(), 4);
        assert!(head.csv_rows((), &cell).contains(",one-rest-cycle,0,1,0,0,0,"));
        assert_eq!(one.global(head).unwrap().scene.gap.0.text(), "1");
    }
}

/// The limit that leaves a component of a point undecided is written with it; a point that is interrupted has no line.
#[test]
fn a_point_that_is_undecided_says_which_limit_left_it() {
    let start = "time = 0, wall = \"left\", velocity = 0";
    let scene = scene_of("amplitude = 1, frequency = 1, phase = 0", "gap = \"3*pi\", restitution = 0.5", start);
    let plane = plane(["amplitude=1..2:2", "restitution=0.5..0.6:2"], false);
    let few = GlobalSettings { boxes: 1 << 8, ..GlobalSettings::default() };
    let limits = [
        (GlobalSettings { most: 1_000, ..few }, "most"),
        (GlobalSettings { halvings: 0, ..few }, "halvings"),
        (GlobalSettings { work: 1, ..few }, "work"),
    ];
    for (settings, name) in limits {
        let found = record(&scene, &plane, &settings, 0, &Unwatched).unwrap();
        let reasons: Vec<_> = found.components.iter().filter_map(|own| own.reason).collect();
        assert!(found.n_undecided > 0 && reasons.len() as u64 == found.n_undecided);
        assert!(reasons.iter().all(|reason| reason.to_string() == name), "{name}: {reasons:?}");
    }
    let stop = |_: impact_pair::watch::Stage<'_>| impact_pair::watch::proceed_if(false);
    assert!(record(&scene, &plane, &few, 0, &stop).is_none());
}
