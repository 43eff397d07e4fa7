fn main() {
    let a: Vec<String> = std::env::args().collect();
    let scene = impact_pair::Scene::parse(&std::fs::read_to_string(&a[1]).unwrap()).unwrap();
    let p = |i: usize| a[i].parse::<usize>().unwrap();
    for n in p(3)..=p(4) {
        let begun = std::time::Instant::now();
        let r =
            impact_pair::chaos::Cycles::of(&scene, p(2) as u32, &(n as u32..=n as u32), Default::default(), &|_| true)
                .unwrap()
                .unwrap();
        println!(
            "{n}: {:?} cycles {} undecided {} no attractor {} {:?}",
            r.fixed_points(),
            r.cycles().len(),
            r.undecided().len(),
            r.has_no_attractor(),
            begun.elapsed()
        );
    }
}
