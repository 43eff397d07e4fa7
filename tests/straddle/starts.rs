//! Starts that straddle the branches of the code: just before, at and after an extremum, a graze, a release, a wall.
//!
//! Random starts do not find what a reader finds: a wrong branch is as thin as the clamp, rounding or comparison that makes it.
//! Each family here puts one quantity at `0` or `+-10^-6 ... 10^-60` (or a power of two) from where the code decides. All data
//! are exact expressions of the scene file, so a touch can be aimed at exactly. Families tell lengths in gaps and times in forcing periods;
//! the scene has them in other units now and then, and its phase in `tau` or in the start's time.
//!
//! `run` and `check` are asked of them here, the simulator in MPFR by `validation/truth`, and that in Arb by `validation/arb`, which reads
//! those that `validation/arb/straddling.jsonl` has.

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
    fn offset(&mut self) -> String {
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

    /// A restitution from which a velocity after an impact can be told that before it.
    fn bouncing(&mut self) -> &'static str {
        self.pick(&["1/2", "1", "0.8", "1-1/10^16"])
    }

    /// A phase in forcing periods that nothing is special about.
    fn phase(&mut self) -> String {
        format!("{}/{}", self.below(37), 37)
    }

    /// A random whole number of quarter periods, up to a forcing period away.
    fn quarter(&mut self) -> String {
        format!("{}/4", self.below(9) as i64 - 4)
    }

    fn wall(&mut self) -> &'static str {
        self.pick(&["left", "right"])
    }
}

/// The parts of a scene, as expressions: lengths in gaps, times in forcing periods, velocities in gaps per forcing period.
pub struct Parts {
    amplitude: String,
    gap: String,
    restitution: String,
    /// The start's phase, but for `offset`.
    phase: String,
    offset: String,
    wall: Option<&'static str>,
    position: String,
    velocity: String,
    /// Amplitudes and frequencies of several harmonics, as lists.
    several: Option<[String; 2]>,
}

/// One harmonic, and a gap of one.
fn plain(amplitude: &str, restitution: &str, phase: &str, offset: &str) -> Parts {
    let [amplitude, restitution, phase, offset] = [amplitude, restitution, phase, offset].map(str::to_owned);
    let [position, velocity] = [const { String::new() }; 2];
    Parts { amplitude, gap: "1".into(), restitution, phase, offset, wall: None, position, velocity, several: None }
}

impl Parts {
    fn inside(self, position: &str, velocity: &str) -> Self {
        Self { position: position.into(), velocity: velocity.into(), ..self }
    }

    /// On a wall, with this speed before the impact.
    fn on(self, wall: &'static str, speed: &str) -> Self {
        let sign = if wall == "left" { "-" } else { "" };
        Self { wall: Some(wall), velocity: format!("{sign}({speed})"), ..self }
    }

    /// From the right wall: half a forcing period later everything is mirrored.
    fn mirrored(self, wall: &'static str) -> Self {
        if wall == "left" { self } else { Self { phase: format!("{}+1/2", self.phase), ..self } }
    }

    /// The scene, with its phase in `tau` or in the time; in other units where each datum is a number.
    fn scene(&self, dice: &mut Dice) -> String {
        let Self { restitution, phase, offset, .. } = self;
        let [mut amplitude, mut gap, mut position, mut velocity] =
            [&self.amplitude, &self.gap, &self.position, &self.velocity].map(String::clone);
        let is_point =
            ![&amplitude, &gap, &position, &velocity, phase, restitution].iter().any(|text| text.contains('['));
        let (tau, mut time) = match self.several.is_none() && is_point && dice.below(2) == 0 {
            true => (multiple_of_pi(phase), offset.trim_start_matches('+').to_owned()),
            false => ("0".into(), format!("{phase}{offset}")),
        };
        let mut frequency = "2*pi";
        if self.several.is_none() && is_point && dice.below(2) == 0 {
            frequency = dice.pick(&["pi", "1", "sqrt(2)", "300*pi", "1e-280", "1e290"]);
            let length = dice.pick(&["1/3", "sqrt(5)", "1/1000", "77*pi", "1e-290", "1e280"]);
            [&mut amplitude, &mut gap, &mut position].into_iter().for_each(|text| *text = format!("({text})*{length}"));
            velocity = format!("({velocity})*{length}*{frequency}/(2*pi)");
            time = format!("({time})*2*pi/{frequency}");
        }
        let place = match self.wall {
            Some(wall) => format!("wall = \"{wall}\""),
            None => format!("position = \"{position}\""),
        };
        let [amplitude, frequency] =
            self.several.clone().unwrap_or_else(|| [format!("\"{amplitude}\""), format!("\"{frequency}\"")]);
        format!(
            "excitation = {{ amplitude = {amplitude}, frequency = {frequency}, phase = \"{tau}\" }}\n\
             pair = {{ gap = \"{gap}\", restitution = \"{restitution}\" }}\n\
             start = {{ time = \"{time}\", {place}, velocity = \"{velocity}\" }}\n"
        )
    }
}

/// A phase in radians; of a whole number of half periods `k*pi`: then it is exact in balls, too.
fn multiple_of_pi(phase: &str) -> String {
    let quarters = phase.strip_suffix("/4").and_then(|quarters| quarters.parse::<i64>().ok());
    quarters
        .filter(|quarters| quarters % 2 == 0)
        .map_or_else(|| format!("2*pi*({phase})"), |quarters| format!("{}*pi", quarters / 2))
}

fn cos(phase: &str) -> String {
    format!("cos(2*pi*({phase}))")
}

fn sin(phase: &str) -> String {
    format!("sin(2*pi*({phase}))")
}

/// The drift of a motion with an extremum at the phase `end`, its velocity at the phase `begin`, and its way from there to the extremum.
fn touch(amplitude: &str, begin: &str, end: &str, turns: u64) -> [String; 3] {
    let drift = format!("2*pi*{amplitude}*{}", cos(end));
    let velocity = format!("({drift}-2*pi*{amplitude}*{})", cos(begin));
    let way = format!("({drift}*(({end})-({begin})+{turns})-{amplitude}*({}-{}))", sin(end), sin(begin));
    [drift, velocity, way]
}

/// Inside the gap, next to an extremum, a wall, or both.
fn near_an_extremum(dice: &mut Dice) -> Parts {
    let phase = if dice.below(3) == 0 { dice.quarter() } else { dice.phase() };
    let place = if dice.below(4) == 0 { "1/4".into() } else { format!("1/2-{}", dice.small()) };
    let (amplitude, offset) = (dice.amplitude(), dice.offset());
    let mut velocity = format!("{}{}", dice.sign(), dice.speed());
    if dice.below(4) == 0 {
        // The extremum has just been, or is about to be.
        velocity = format!(
            "2*pi*({amplitude})*({}-{})",
            cos(&format!("{phase}{}", dice.offset())),
            cos(&format!("{phase}{offset}"))
        );
    }
    let position = format!("{}({place})", dice.sign());
    plain(amplitude, dice.restitution(), &phase, &offset).inside(&position, &velocity)
}

/// A later extremum touches its wall or nearly: the motion starts inside the gap.
fn later_touch(dice: &mut Dice) -> Parts {
    let (end, turns) = (dice.phase(), dice.below(4));
    // At a start with hardly any velocity the drift is that of the phase itself.
    let begin = if dice.below(3) == 0 { format!("1-({end})") } else { dice.phase() };
    let amplitude = dice.pick(&["1/10", "1/20", "1/100", "1/1000", "0.3"]);
    let [_, velocity, way] = touch(amplitude, &begin, &end, turns);
    let position = format!("{}-{way}{}", dice.pick(&["1/2", "-1/2"]), dice.offset());
    plain(amplitude, dice.restitution(), &begin, "+0").inside(&position, &format!("{velocity}{}", dice.offset()))
}

/// From a wall an extremum touches the other one, or nearly: the gap is made for it, or the amplitude.
fn far_touch(dice: &mut Dice) -> Parts {
    let (begin, end, turns, wall) = (dice.phase(), dice.phase(), dice.below(4), dice.wall());
    let [_, velocity, way] = touch("1", &begin, &end, turns);
    let restitution = dice.bouncing();
    let speed = format!("{velocity}/({restitution})");
    let parts = plain("1", restitution, &begin, "+0");
    match dice.below(2) {
        0 => Parts { gap: format!("{way}{}", dice.offset()), ..parts }.mirrored(wall).on(wall, &speed),
        _ => {
            let amplitude = format!("((1{})/{way})", dice.offset());
            Parts { amplitude: amplitude.clone(), ..parts }.mirrored(wall).on(wall, &format!("{speed}*{amplitude}"))
        }
    }
}

/// Phases from which hops of the left wall graze it again, at the phases beside them.
const GRAZING_HOPS: [[&str; 2]; 4] = [
    ["-0.078363291643947286495593422481847920304281715221639569849222084262481869654311087753608666456", "5/128"],
    ["-0.19100959369824913482738330553139909419679104380622608750231927741672519325212645923552025879", "12/128"],
    ["-0.33158877706486718428518275640281807991168660438637171854612975570192552802926870979555542616", "20/128"],
    ["-0.48521318598374275524509562157206293400107179003689170026071831776236054884360078727331070508", "27/128"],
];

/// A hop from a wall that grazes the same wall, or nearly.
fn own_touch(dice: &mut Dice) -> Parts {
    let ([begin, end], wall) = (GRAZING_HOPS[dice.below(4) as usize], dice.wall());
    let amplitude = dice.pick(&["1/25", "0.1", "1/5", "1/500"]);
    let [_, velocity, _] = touch(amplitude, begin, end, 0);
    let restitution = dice.bouncing();
    let speed = format!("({velocity}{})/({restitution})", dice.offset());
    plain(amplitude, restitution, begin, "+0").mirrored(wall).on(wall, &speed)
}

/// A start on a wall where the contact force begins or ends, at rest or slow.
fn edge_of_pressure(dice: &mut Dice) -> Parts {
    let speed = if dice.below(2) == 0 { "0".into() } else { dice.speed() };
    let parts = plain(dice.amplitude(), dice.restitution(), &dice.quarter(), &dice.offset());
    Parts { gap: dice.pick(&["1", "4", "1/3"]).into(), ..parts }.on(dice.wall(), &speed)
}

/// Slow bounces anywhere.
fn slow_bounce(dice: &mut Dice) -> Parts {
    let (phase, speed) = (dice.phase(), dice.speed());
    plain(dice.amplitude(), dice.restitution(), &phase, "+0").on(dice.wall(), &speed)
}

/// Flights of many forcing periods, at any time.
fn many_turns(dice: &mut Dice) -> Parts {
    let power = |dice: &mut Dice, most| format!("2^{}", dice.below(most));
    let time = format!("{}{}+{}", dice.sign(), power(dice, 60), dice.quarter());
    let amplitude = dice.pick(&["0", "1/10^30", "1/10^9", "1/1000"]);
    let speed = format!("1/{}{}", power(dice, 58), dice.offset());
    plain(amplitude, dice.pick(&["1", "1/2", "1-1/10^16"]), &time, "+0").on(dice.wall(), &speed)
}

/// A start with no drift, or hardly any; the first extrema, of one height, are at a wall now and then.
fn no_drift(dice: &mut Dice) -> Parts {
    let phase = if dice.below(2) == 0 { dice.phase() } else { dice.quarter() };
    let amplitude = dice.pick(&["1/10", "1/2", "1/4", "1/1000"]);
    let velocity = format!("-2*pi*{amplitude}*{}{}", cos(&phase), dice.offset());
    let at_wall = format!("1/2-{amplitude}*(1+{}){}", sin(&phase), dice.offset());
    let place = dice.pick(&["0", "1/4", "-0.4", &at_wall]).to_owned();
    plain(amplitude, dice.restitution(), &phase, "+0").inside(&place, &velocity)
}

/// A drift next to the box's greatest speed: extrema are about to appear.
fn drift_of_the_box(dice: &mut Dice) -> Parts {
    let (phase, offset) = match dice.below(3) {
        0 => (dice.phase(), "+0".into()),
        1 => (dice.quarter(), dice.offset()),
        _ => (dice.quarter(), "+0".into()),
    };
    let amplitude = dice.pick(&["1/10", "1", "1/1000", "3", "25"]);
    let velocity = format!("2*pi*{amplitude}*({}1-{}){}", dice.sign(), cos(&format!("{phase}{offset}")), dice.offset());
    plain(amplitude, dice.restitution(), &phase, &offset).inside(dice.pick(&["0", "1/4", "-0.4"]), &velocity)
}

/// Two or three harmonics, on a wall or next to one.
fn several(dice: &mut Dice) -> Parts {
    let quiet = dice.pick(&["1/3", "1/10", "1/10^12", "1"]);
    let fast = dice.pick(&["6*pi", "4*pi", "2*pi*sqrt(2)", "3*pi"]);
    // Amplitudes for which a wall is reached within a few forcing periods: longer flights are for other tests.
    let amplitude = dice.pick(&["1", "3/2", "3", "10"]);
    let phase = if dice.below(2) == 0 { dice.phase() } else { dice.quarter() };
    let speed = dice.speed();
    let lists = [format!("[\"{amplitude}\", \"{quiet}\"]"), format!("[\"2*pi\", \"{fast}\"]")];
    let parts = Parts { several: Some(lists), ..plain("1", dice.restitution(), &phase, &dice.offset()) };
    if dice.below(2) == 0 {
        let position = format!("{}(1/2-{})", dice.sign(), dice.small());
        return parts.inside(&position, &format!("{}{speed}", dice.sign()));
    }
    parts.on(dice.wall(), &speed)
}

/// Data known to an interval, where a point would straddle.
fn boxes(dice: &mut Dice) -> Parts {
    let half = dice.small();
    let around = |x: &str| format!("[{x}-{half}, {x}+{half}]");
    let (phase, offset, speed) = (dice.quarter(), dice.offset(), dice.speed());
    let (amplitude, restitution) = (dice.pick(&["0.3", "1", "3"]), dice.pick(&["1/2", "0.8"]));
    let position = format!("{}(1/4)", dice.sign());
    let mut parts = match dice.below(4) {
        0 => plain(amplitude, restitution, &around(&format!("{phase}{offset}")), "").inside(&position, &speed),
        1 => plain(amplitude, restitution, &phase, &offset).inside(&position, &around(&speed)),
        2 => plain(amplitude, &around(restitution), &phase, &offset).on(dice.wall(), &speed),
        _ => plain(&around(amplitude), restitution, &phase, &offset).on(dice.wall(), &speed),
    };
    if dice.below(4) == 0 {
        parts.gap = around("1");
    }
    parts
}

/// A phase that its mirror would round to a quarter period, in doubles.
fn mirrored_phase(dice: &mut Dice) -> Parts {
    let offset = format!("{}1/2^{}", dice.sign(), 50 + dice.below(30));
    let (phase, speed) = (dice.quarter(), dice.speed());
    plain(dice.pick(&["1", "1/10", "10"]), dice.restitution(), &phase, &offset).on(dice.wall(), &speed)
}

pub type Family = (&'static str, fn(&mut Dice) -> Parts);

/// All families, those of one decision first.
pub const FAMILIES: [Family; 12] = [
    ("next to an extremum", near_an_extremum),
    ("a later touch", later_touch),
    ("a touch of the far wall", far_touch),
    ("a touch of the own wall", own_touch),
    ("edge of the pressure", edge_of_pressure),
    ("slow bounces", slow_bounce),
    ("many turns", many_turns),
    ("no drift", no_drift),
    ("drift of the box", drift_of_the_box),
    ("several harmonics", several),
    ("boxes of data", boxes),
    ("a mirrored phase", mirrored_phase),
];

/// The next case; families in turn.
pub fn case(dice: &mut Dice, number: u64) -> Case {
    let (family, make) = FAMILIES[number as usize % FAMILIES.len()];
    loop {
        let text = make(dice).scene(dice);
        // Not all that is drawn is a start inside the gap, or on a wall and towards it.
        if let Ok(scene) = Scene::parse(&text) {
            return Case { family, text, scene, impacts: 1 + dice.below(4) };
        }
    }
}
