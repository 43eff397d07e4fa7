//! Starts that straddle the branches of the code: just before, at and after an extremum, a graze, a release, a wall.
//!
//! Random starts do not find what a reader finds: a wrong branch is as thin as the clamp, rounding or comparison that makes it.
//! Each family here puts one quantity at `0` or `+-10^-6 ... 10^-60` (or a power of two) from where the code decides. All data
//! are exact expressions of the scene file, so a touch can be aimed at exactly. `W = 2 pi` and `tau = 0`: times are in forcing periods.

use impact_pair::Scene;

/// A scene with the family it comes from.
pub struct Case {
    pub family: &'static str,
    /// The scene file, and what it says.
    pub text: String,
    pub scene: Scene,
    pub impacts: u64,
}

/// A sequence of random numbers: splitmix64 of Steele, Lea and Flood (2014).
pub struct Dice(pub u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    pub fn pick<'a>(&mut self, from: &[&'a str]) -> &'a str {
        from[self.below(from.len() as u64) as usize]
    }

    fn sign(&mut self) -> &'static str {
        self.pick(&["+", "-"])
    }

    /// `10^-k` or a power of two as small.
    fn small(&mut self) -> String {
        let k = 6 + self.below(55);
        match self.below(3) {
            0 => format!("1/2^{}", 10 * k / 3),
            _ => format!("1/10^{k}"),
        }
    }

    /// Nothing, or a little more or less.
    pub fn offset(&mut self) -> String {
        if self.below(6) == 0 { "+0".into() } else { format!("{}{}", self.sign(), self.small()) }
    }

    /// A speed of `10^0` to `10^-60`, now and then none.
    fn speed(&mut self) -> String {
        match self.below(8) {
            0 => "0".into(),
            1 => format!("{}/10", 1 + self.below(40)),
            _ => self.small(),
        }
    }

    fn amplitude(&mut self) -> &'static str {
        self.pick(&["0.1", "0.3", "1/2", "1", "3", "10", "1000", "1/1000", "1/10^30"])
    }

    fn restitution(&mut self) -> &'static str {
        self.pick(&["0", "1/10^30", "1/2", "0.8", "1-1/10^16", "1"])
    }

    /// A phase in forcing periods that nothing is special about.
    fn phase(&mut self) -> String {
        format!("{}/{}", self.below(37), 37)
    }

    /// A random whole number of quarter periods, up to a forcing period away.
    fn quarter(&mut self) -> String {
        format!("{}/4", self.below(9) as i64 - 4)
    }
}

/// The parts of a scene, as expressions.
pub struct Parts {
    amplitude: String,
    frequency: String,
    gap: String,
    restitution: String,
    start: String,
}

impl Parts {
    fn scene(&self) -> String {
        let Self { amplitude, frequency, gap, restitution, start } = self;
        format!(
            "excitation = {{ amplitude = {amplitude}, frequency = {frequency}, phase = 0 }}\n\
             pair = {{ gap = \"{gap}\", restitution = \"{restitution}\" }}\nstart = {{ {start} }}\n"
        )
    }
}

fn plain(amplitude: &str, gap: &str, restitution: &str, start: String) -> Parts {
    Parts {
        amplitude: format!("\"{amplitude}\""),
        frequency: "\"2*pi\"".into(),
        gap: gap.into(),
        restitution: restitution.into(),
        start,
    }
}

fn inside(time: &str, position: &str, velocity: &str) -> String {
    format!("time = \"{time}\", position = \"{position}\", velocity = \"{velocity}\"")
}

fn on_wall(dice: &mut Dice, time: &str, speed: &str) -> String {
    let (wall, sign) = if dice.below(2) == 0 { ("left", "-") } else { ("right", "") };
    format!("time = \"{time}\", wall = \"{wall}\", velocity = \"{sign}({speed})\"")
}

/// Inside the gap, next to an extremum, a wall, or both.
fn near_an_extremum(dice: &mut Dice) -> Parts {
    let time = format!("{}{}", dice.phase(), dice.offset());
    let place = if dice.below(4) == 0 { "1/4".into() } else { format!("1/2-{}", dice.small()) };
    let (sign, speed) = (dice.sign(), dice.speed());
    let position = format!("{}({place})", dice.sign());
    plain(dice.amplitude(), "1", dice.restitution(), inside(&time, &position, &format!("{sign}{speed}")))
}

/// A later extremum, at the phase `p1`, touches its wall or nearly: the motion starts inside the gap at the phase `p0`.
fn later_touch(dice: &mut Dice) -> Parts {
    let (p0, p1, turns) = (dice.phase(), dice.phase(), dice.below(4));
    // At a start with hardly any velocity the drift is that of the phase itself.
    let p0 = if dice.below(3) == 0 { format!("1-({p1})") } else { p0 };
    let amplitude = dice.pick(&["1/10", "1/20", "1/100", "1/1000", "0.3"]);
    let cos = |p: &str| format!("cos(2*pi*({p}))");
    let sin = |p: &str| format!("sin(2*pi*({p}))");
    let drift = format!("2*pi*{amplitude}*{}", cos(&p1));
    let velocity = format!("{drift}-2*pi*{amplitude}*{}{}", cos(&p0), dice.offset());
    let way = format!("{drift}*(({p1})-({p0})+{turns})-{amplitude}*({}-{})", sin(&p1), sin(&p0));
    let wall = dice.pick(&["1/2", "-1/2"]);
    let position = format!("{wall}-({way}){}", dice.offset());
    plain(amplitude, "1", dice.restitution(), inside(&p0, &position, &velocity))
}

/// The same from a wall: the gap is made for it.
fn later_touch_from_a_wall(dice: &mut Dice) -> Parts {
    let (p0, p1, turns) = (dice.phase(), dice.phase(), dice.below(4));
    let drift = format!("2*pi*cos(2*pi*({p1}))");
    let after = format!("({drift}-2*pi*cos(2*pi*({p0})))");
    let gap = format!("{drift}*(({p1})-({p0})+{turns})-(sin(2*pi*({p1}))-sin(2*pi*({p0}))){}", dice.offset());
    let restitution = dice.pick(&["1/2", "1", "0.8"]);
    let start = format!("time = \"{p0}\", wall = \"left\", velocity = \"-{after}/({restitution})\"");
    plain("1", &gap, restitution, start)
}

/// A start on a wall where the contact force begins or ends, at rest or slow.
fn edge_of_pressure(dice: &mut Dice) -> Parts {
    let time = format!("{}{}", dice.quarter(), dice.offset());
    let speed = if dice.below(2) == 0 { "0".into() } else { dice.speed() };
    let gap = dice.pick(&["1", "4", "1/3"]);
    let start = on_wall(dice, &time, &speed);
    plain(dice.amplitude(), gap, dice.restitution(), start)
}

/// Slow bounces anywhere.
fn slow_bounce(dice: &mut Dice) -> Parts {
    let (time, speed) = (dice.phase(), dice.speed());
    let start = on_wall(dice, &time, &speed);
    plain(dice.amplitude(), "1", dice.restitution(), start)
}

/// Flights of many forcing periods, at any time.
fn many_turns(dice: &mut Dice) -> Parts {
    let power = |dice: &mut Dice, most| format!("2^{}", dice.below(most));
    let time = format!("{}{}+{}", dice.sign(), power(dice, 60), dice.quarter());
    let amplitude = dice.pick(&["0", "1/10^30", "1/10^9", "1/1000"]);
    let speed = format!("1/{}{}", power(dice, 58), dice.offset());
    let restitution = dice.pick(&["1", "1/2", "1-1/10^16"]);
    let start = on_wall(dice, &time, &speed);
    plain(amplitude, "1", restitution, start)
}

/// A start with no drift, or hardly any.
fn no_drift(dice: &mut Dice) -> Parts {
    let phase = if dice.below(2) == 0 { dice.phase() } else { dice.quarter() };
    let amplitude = dice.pick(&["1/10", "1/2", "1/4", "1/1000"]);
    let velocity = format!("-2*pi*{amplitude}*cos(2*pi*({phase})){}", dice.offset());
    let place = dice.pick(&["0", "1/4", "-0.4"]);
    plain(amplitude, "1", dice.restitution(), inside(&phase, place, &velocity))
}

/// A drift next to the box's greatest speed: extrema are about to appear.
fn drift_of_the_box(dice: &mut Dice) -> Parts {
    let phase = match dice.below(3) {
        0 => dice.phase(),
        1 => format!("{}{}", dice.quarter(), dice.offset()),
        _ => dice.quarter(),
    };
    let amplitude = dice.pick(&["1/10", "1", "1/1000", "3"]);
    let sign = dice.sign();
    let velocity = format!("2*pi*{amplitude}*({sign}1-cos(2*pi*({phase}))){}", dice.offset());
    let place = dice.pick(&["0", "1/4", "-0.4"]);
    plain(amplitude, "1", dice.restitution(), inside(&phase, place, &velocity))
}

/// Two or three harmonics, on a wall or next to one.
fn several(dice: &mut Dice) -> Parts {
    let quiet = dice.pick(&["1/3", "1/10", "1/10^12", "1"]);
    let fast = dice.pick(&["6*pi", "4*pi", "2*pi*sqrt(2)", "3*pi"]);
    // Amplitudes for which a wall is reached within a few forcing periods: longer flights are for other tests.
    let amplitude = dice.pick(&["1", "3/2", "3", "10"]);
    let phase = if dice.below(2) == 0 { dice.phase() } else { dice.quarter() };
    let time = format!("{phase}{}", dice.offset());
    let (sign, speed) = (dice.sign(), dice.speed());
    let start = if dice.below(2) == 0 {
        let position = format!("{}(1/2-{})", dice.sign(), dice.small());
        inside(&time, &position, &format!("{sign}{speed}"))
    } else {
        on_wall(dice, &time, &speed)
    };
    let lists = (format!("[\"{amplitude}\", \"{quiet}\"]"), format!("[\"2*pi\", \"{fast}\"]"));
    Parts { amplitude: lists.0, frequency: lists.1, ..plain("1", "1", dice.restitution(), start) }
}

/// Data known to an interval, where a point would straddle.
fn boxes(dice: &mut Dice) -> Parts {
    let half = dice.small();
    let around = |x: &str| format!("[{x}-{half}, {x}+{half}]");
    let (time, speed) = (format!("{}{}", dice.quarter(), dice.offset()), dice.speed());
    let (amplitude, restitution) = (dice.pick(&["0.3", "1", "3"]), dice.pick(&["1/2", "0.8"]));
    let position = format!("{}(1/4)", dice.sign());
    let mut parts = match dice.below(4) {
        0 => plain(amplitude, "1", restitution, inside(&around(&time), &position, &speed)),
        1 => plain(amplitude, "1", restitution, inside(&time, &position, &around(&speed))),
        2 => plain(amplitude, "1", &around(restitution), on_wall(dice, &time, &speed)),
        _ => plain(&around(amplitude), "1", restitution, on_wall(dice, &time, &speed)),
    };
    if dice.below(4) == 0 {
        parts.gap = around("1");
    }
    parts
}

pub type Family = (&'static str, fn(&mut Dice) -> Parts);

/// All families, those of one decision first.
pub const FAMILIES: [Family; 11] = [
    ("next to an extremum", near_an_extremum),
    ("a later touch", later_touch),
    ("a later touch from a wall", later_touch_from_a_wall),
    ("edge of the pressure", edge_of_pressure),
    ("slow bounces", slow_bounce),
    ("many turns", many_turns),
    ("no drift", no_drift),
    ("drift of the box", drift_of_the_box),
    ("several harmonics", several),
    ("boxes of data", boxes),
    ("a mirrored phase", mirrored_phase),
];

/// A phase that its mirror would round to a quarter period, in doubles.
fn mirrored_phase(dice: &mut Dice) -> Parts {
    let power = 50 + dice.below(30);
    let time = format!("{}{}1/2^{power}", dice.quarter(), dice.sign());
    let speed = dice.speed();
    let start = on_wall(dice, &time, &speed);
    plain(dice.pick(&["1", "1/10", "10"]), "1", dice.restitution(), start)
}

/// The next case; families in turn.
pub fn case(dice: &mut Dice, number: u64) -> Case {
    let (family, make) = FAMILIES[number as usize % FAMILIES.len()];
    loop {
        let text = make(dice).scene();
        // Not all that is drawn is a start inside the gap, or on a wall and towards it.
        if let Ok(scene) = Scene::parse(&text) {
            return Case { family, text, scene, impacts: 1 + dice.below(4) };
        }
    }
}
