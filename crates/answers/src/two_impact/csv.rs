//! A parameter manifold as a table for programs.

use impact_pair::exact::decimal_bounds;
use impact_pair::two_impact::{Axis, Manifold, Part};

/// One line per point; the last three columns hold from there to the next point of the same N.
pub fn csv(axis: Axis, curves: &[Manifold]) -> String {
    let key = axis.kind();
    let mut text =
        format!("cycles,mark,{key}_lower,{key}_upper,amplitude_lower,amplitude_upper,sine,physical,stability\n");
    for curve in curves {
        for point in &curve.points {
            let ([at0, at1], [a0, a1]) = (decimal_bounds(&point.at), decimal_bounds(&point.amplitude));
            let mark = point.mark.map_or(String::new(), |mark| mark.to_string());
            let after = point.after.map_or(",,".to_owned(), |Part { is_solid, is_physical, stability }| {
                let sine = if is_solid { "positive" } else { "negative" };
                format!("{sine},{is_physical},{stability}")
            });
            text += &format!("{},{mark},{at0},{at1},{a0},{a1},{after}\n", curve.cycles);
        }
    }
    text
}
