use impact_pair::exact::*;
use impact_pair::two_impact::*;
use impact_pair::*;

fn pair(a: &str, w: &str, d: &str, e: &str) -> ImpactPair {
    let x = |t: &str| Exact::parse(t).unwrap();
    ImpactPair::new(Harmonic::new(x(a), x(w), x("0")).unwrap(), x(d), x(e)).unwrap()
}

#[test]
fn explore() {
    for (a, d, e, n) in [
        ("1", "3*pi", "0.5", 1),
        ("2", "9.42497", "0.5", 1),
        ("0.36", "1", "0.8", 1),
        ("1", "10.82", "0.5", 2),
        ("1", "14.21", "0.5", 4),
        ("0.3", "1", "0.8", 3),
        ("1", "0.5", "0.5", 2),
        ("1", "20", "1", 2),
        ("1", "20", "1", 3),
        ("1", "20", "1", 4),
        ("0.5", "1", "0.8", 1),
        ("0.5", "1", "0.8", 2),
        ("0.3458892783", "1", "0.8", 1),
        ("1", "0.05", "0.8", 3),
        ("1", "pi", "0", 1),
        ("1", "3", "0", 1),
    ] {
        let pair = pair(a, "pi", d, e);
        let t = std::time::Instant::now();
        let answer = Question::new(&pair, n, Unknown::Velocity).unwrap().answer(12);
        println!(
            "A={a} d={d} e={e} N={n}: complete {} exhaustive {} in {:?}",
            answer.is_complete,
            answer.is_exhaustive,
            t.elapsed()
        );
        for o in &answer.orbits {
            println!(
                "   th0 {} th1 {} v {} unique {} physical {:?} sym {} {:?} tr {}",
                decimal_digits(&o.impacts[0].phase),
                decimal_digits(&o.impacts[1].phase),
                decimal_digits(&o.impacts[1].velocity),
                o.is_unique,
                o.is_physical,
                o.is_symmetric,
                o.stability,
                decimal_digits(&o.trace)
            );
        }
        for u in &answer.undecided {
            println!("   ? {}", decimal_digits(u));
        }
    }
}
