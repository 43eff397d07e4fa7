fn main() {
    let a: Vec<String> = std::env::args().collect();
    let scene = impact_pair::Scene::parse(&std::fs::read_to_string(&a[1]).unwrap()).unwrap();
    let p = |i: usize| a[i].parse::<usize>().unwrap();
    let r = impact_pair::chaos::cycles::count(&scene, p(2) as u32, p(3)..=p(4), 1.0 / p(5) as f64, p(6) as i64, p(7) as i64).unwrap();
    println!("{r:?}");
}
