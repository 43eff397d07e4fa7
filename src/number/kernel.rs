//! Sine and cosine of an angle in periods, with error bounds that Gappa and Coq have checked.
//!
//! The phase is counted in periods (`theta = 2 pi u`), so that taking off quarter periods is exact. What is
//! left is `|r| <= 1/8`, and with `x = r^2`
//!
//! ```text
//! 2 pi r - sin 2 pi r ~ r^3 P(x),   P(x) = P_0 + x * (P_TAIL[0] + P_TAIL[1] x + ... + P_TAIL[5] x^5)
//! 1 - cos 2 pi r      ~ r^2 Q(x),   Q(x) = Q_0 + x * (Q_TAIL[0] + Q_TAIL[1] x + ... + Q_TAIL[5] x^5)
//! ```
//!
//! All operations round to nearest (binary64, ties to even); `mul_add` rounds once on every target, but is a slow
//! library call where the target has no FMA (build with `target-cpu=x86-64-v3` or later).
//!
//! **Lemma K1** ([`sin_cos`]). Let `|u| <= 2^40`. (a) `k = round(4u)` and `r = u - k/4` are computed without
//! error, and `|r| <= 1/8`. (b) Both results are within [`SIN_COS_ERROR`] of the truth and in `[-1, 1]`.
//! (c) Quarter periods give exactly -1, 0, 1; `sin_cos(-u)` is exactly `(-sin, cos)` of `sin_cos(u)`.
//!
//! *Proof.* (a) `u + MAGIC` lies in `[2^50, 2^51]`, where the doubles are the multiples of 1/4: its rounding is
//! `MAGIC + k/4` with `|u - k/4| <= 1/8`, and subtracting `MAGIC` is exact. For `k = 0`, `r = u`. Otherwise
//! `1/8 <= |u| <= 2^40`, hence ulp(u) <= 2^-12; u and k/4 are multiples of ulp(u), so is r; as
//! `|r| <= 1/8 <= |u|`, r is a double and the subtraction returns it. (b) For `|r| <= 1/8`: `prove`, K1.
//! By (a), u is k quarter periods beyond r; turning by them multiplies by -1, 0 and 1 and adds zeros: exact.
//! (c) r = 0 gives (0, 1). `MAGIC` is an even number of quarters, so ties go to even k and k is odd in u; so is
//! r; the sine at r is made of products and sums odd in r, the cosine sees only `r * r`. []
//!
//! **Lemma K2** ([`departure`]). For `h = 0` or `2^-300 <= h <= 1/8` each field is within the relative error
//! [`DEPARTURE_ERROR`] of the truth. *Proof.* `h = 0` gives zeros; the rest: `prove`, K2. []
//!
//! **Lemma K3** ([`acos_coarse`]). For `-1 <= q <= 1` the result lies in `[0, 1/2]` and within [`ACOS_ERROR`] of
//! `acos(q) / (2 pi)`. *Proof.* `acos(1 - s^2) = 2 atan(s / sqrt(2 - s^2))`, `acos(-q) = pi - acos(q)`, and
//! `prove`, K3. []
//!
//! `prove` is `validation/kernel/prove`: it reads the constants *and the `let` lines* of this file, lets Coq bound the
//! error of the polynomials and Gappa that of the operations, so that proof and code cannot drift apart. What it
//! reads must stay as plain as it is: `let name = expression;` with `+ - *`, `mul_add`, `sqrt`, `abs`, calls of `tail`
//! and `sine`. The coefficients were printed by `validation/kernel/coefficients.py`; they are not trusted.

/// Absolute error of both results of [`sin_cos`]: `0x1.8p-54`, that is 0.75 * 2^-53 (Lemma K1).
pub const SIN_COS_ERROR: f64 = 3.0 / (1_u64 << 55) as f64;

/// Relative error of every field of [`SmallAngle`]: `0x1p-51` (Lemma K2).
pub const DEPARTURE_ERROR: f64 = 1.0 / (1_u64 << 51) as f64;

/// Absolute error of [`acos_coarse`], in periods: `0x1p-31` (Lemma K3).
pub const ACOS_ERROR: f64 = 1.0 / (1_u64 << 31) as f64;

/// The domain of [`sin_cos`], in periods (Lemma K1).
pub const LARGEST_PHASE: f64 = (1_u64 << 40) as f64;

/// `2 pi` to nearest, `0x1.921fb54442d18p+2`; the bits keep clippy from taking it for a rough constant.
const TAU_HI: f64 = f64::from_bits(0x4019_21fb_5444_2d18);
/// `2 pi - TAU_HI` to nearest, `0x1.1a62633145c07p-52`.
const TAU_LO: f64 = 2.4492935982947064e-16;

/// `(2 pi)^3 / 3!` to nearest, `0x1.4abbce625be53p+5`.
const P_0: f64 = 41.34170224039976;
const P_TAIL: [f64; 6] = [
    -81.60524927607655,  // -0x1.466bc6775ab4bp+6
    76.70585975351457,   // 0x1.32d2cce633a18p+6
    -42.058694010175365, // -0x1.50783490b164fp+5
    15.094647146182455,  // 0x1.e3075973b06d9p+3
    -3.820071945131539,  // -0x1.e8f81e145a812p+1
    0.7164090977774326,  // 0x1.6ecd2c5b0599dp-1
];

/// `(2 pi)^2 / 2!` to nearest, `0x1.3bd3cc9be45dep+4`.
const Q_0: f64 = 19.739208802178716;
const Q_TAIL: [f64; 6] = [
    -64.93939402266695,  // -0x1.03c1f081b5a65p+6
    85.45681720616078,   // 0x1.55d3c7e3c2d7bp+6
    -60.244641266923225, // -0x1.e1f5067b057f8p+5
    26.42624541068296,   // 0x1.a6d1e6b52f412p+4
    -7.902847479415058,  // -0x1.f9c840cb57470p+2
    1.6925560976095027,  // 0x1.b14b5b3de0d19p+0
];

/// `acos(1 - z) / (2 pi sqrt(z))` on `[0, 1]`.
const A: [f64; 9] = [
    0.22507908363990714,     // 0x1.ccf64339f9f54p-3
    0.018756322341769754,    // 0x1.334db7c345ccbp-6
    0.004224766685511222,    // 0x1.14dfd2bf5c3a0p-8
    0.0012214308669211674,   // 0x1.4030d682d13f7p-10
    0.0005683851585796576,   // 0x1.29ff5d574f221p-11
    -0.00017306818283780692, // -0x1.6af345edb4128p-13
    0.0005124187334744903,   // 0x1.0ca7ad9df6b02p-11
    -0.00031673745014524317, // -0x1.4c1f8fd63065fp-12
    0.0001273978764870405,   // 0x1.0b2c36d1a5a80p-13
];

/// `1.5 * 2^50`: next to it the doubles are the multiples of 1/4.
const MAGIC: f64 = (3_u64 << 49) as f64; // K1: exact

/// Versine, excess and sine at a small angle of `h` periods: the differences of cosine and sine from their values and slopes at 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallAngle<N = f64> {
    /// `1 - cos 2 pi h`
    pub versine: N,
    /// `2 pi h - sin 2 pi h`
    pub excess: N,
    /// `sin 2 pi h`
    pub sine: N,
}

/// `c[0] + c[1] x + ... + c[5] x^5` with `x2 = x * x` (Estrin: three short chains instead of one long).
#[inline(always)]
fn tail(c: &[f64; 6], x: f64, x2: f64) -> f64 {
    let low = c[1].mul_add(x, c[0]);
    let middle = c[3].mul_add(x, c[2]);
    let high = c[5].mul_add(x, c[4]);
    high.mul_add(x2, middle).mul_add(x2, low)
}

/// `sin 2 pi r`, odd in `r`, for `|r| <= 1/8`, `x = r * r`, `x2 = x * x`.
#[inline(always)]
fn sine(r: f64, x: f64, x2: f64) -> f64 {
    // All but the last rounding is on terms below 0.081: there the cubic term alone has (pi/4)^3 / 6.
    let cubic = (r * x).mul_add(-P_0, r * TAU_LO);
    let below = (r * x2).mul_add(-tail(&P_TAIL, x, x2), cubic);
    r.mul_add(TAU_HI, below)
}

/// `(sin 2 pi u, cos 2 pi u)` for `|u| <= 2^40`, each within [`SIN_COS_ERROR`] (Lemma K1).
///
/// Quarter periods are exact; sine is odd and cosine even in `u`, exactly (as numbers: a zero may have either
/// sign). Outside the domain the result means nothing.
#[inline(always)]
pub fn sin_cos(u: f64) -> (f64, f64) {
    debug_assert!(u.abs() <= LARGEST_PHASE, "phase {u} is not within 2^40 forcing periods");
    // Lemma K1 (a): exact. The last two bits of `shifted` are those of k, as MAGIC is a whole number.
    let shifted = u + MAGIC;
    let r = u - (shifted - MAGIC);
    let k = shifted.to_bits();

    // Lemma K1 (b). `leading + residue` is 1 - x Q_0 up to 2^-106, so only the last sum rounds near 1.
    let x = r * r;
    let x2 = x * x;
    let sine = sine(r, x, x2);
    let leading = x.mul_add(-Q_0, 1.0);
    let residue = x.mul_add(-Q_0, 1.0 - leading);
    let cosine = leading + x2.mul_add(-tail(&Q_TAIL, x, x2), residue);

    // Turn by k quarters: along = cos(pi k/2), across = sin(pi k/2) are -1, 0 or 1, so nothing rounds. No branch:
    // a random k would defeat its prediction.
    let unit = |quarter: u64| {
        let is_odd = (quarter & 1).wrapping_neg(); // K1: all bits or none
        f64::from_bits((1.0_f64.to_bits() ^ ((quarter & 2) << 62)) & !is_odd)
    };
    let (along, across) = (unit(k), unit(k.wrapping_sub(1))); // K1: the quarter before, modulo 4
    (sine.mul_add(along, cosine * across), cosine.mul_add(along, -(sine * across)))
}

/// Versine, excess and sine of `h` periods, `0 <= h <= 1/8`, without cancellation (Lemma K2).
///
/// For `h = 0` or `h >= 2^-300` each is within the *relative* error [`DEPARTURE_ERROR`]; below that `h^3`
/// underflows and nothing is claimed.
#[inline(always)]
pub fn departure(h: f64) -> SmallAngle {
    debug_assert!((0.0..=0.125).contains(&h), "{h} is not in [0, 1/8]");
    let x = h * h;
    let x2 = x * x;
    let versine = x.mul_add(Q_0, x2 * tail(&Q_TAIL, x, x2));
    let excess = (h * x).mul_add(P_0, (h * x2) * tail(&P_TAIL, x, x2));
    let sine = sine(h, x, x2);
    SmallAngle { versine, excess, sine }
}

/// `acos(q) / (2 pi)` in periods, in `[0, 1/2]`, for `-1 <= q <= 1`, within [`ACOS_ERROR`] (Lemma K3).
#[inline(always)]
pub fn acos_coarse(q: f64) -> f64 {
    debug_assert!(q.abs() <= 1.0, "{q} is not in [-1, 1]");
    let z = 1.0 - q.abs();
    let z2 = z * z;
    let z4 = z2 * z2;
    let low = A[3].mul_add(z, A[2]).mul_add(z2, A[1].mul_add(z, A[0]));
    let high = A[7].mul_add(z, A[6]).mul_add(z2, A[5].mul_add(z, A[4]));
    let angle = z.sqrt() * A[8].mul_add(z4, high).mul_add(z4, low);
    if q < 0.0 { 0.5 - angle } else { angle }
}

#[cfg(test)]
mod tests;
