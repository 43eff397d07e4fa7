//! Lists of motions next to rests, grazes and doubtful contacts: what is true is not called false.

use serde_json::Value;

use super::{answer, disagreements, judged};
use crate::common::program;

/// A scene in a file.
fn scene(excitation: &str, pair: &str, start: &str) -> tempfile::TempPath {
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    let text = format!("excitation = {{ {excitation} }}\npair = {{ {pair} }}\nstart = {{ {start} }}");
    std::fs::write(file.path(), text).unwrap();
    file.into_temp_path()
}

/// One harmonic with W = 2 pi, and starts in the middle of the gap that move to the right.
fn members() -> tempfile::TempPath {
    let start = "time = 0, position = 0, velocity = \"[1.4, 1.6]\"";
    scene("amplitude = 0.1, frequency = \"2*pi\", phase = 0", "gap = 1, restitution = \"[0.1, 0.9]\"", start)
}

/// The audit of a list that nothing disagrees with.
fn agreed(list: &str, scene: &str, tolerance: &str) -> Value {
    let answer = answer(list, &[scene, "-", "--tolerance", tolerance, "--format", "json", "--quiet"]);
    let document: Value = serde_json::from_slice(&answer.stdout).unwrap();
    assert_eq!(disagreements(&document), [], "{document}");
    document
}

/// Lists are orbits of members of the data, by `run --digits 14` (e = 1/2, v = 1.41) and by mpmath.
#[test]
fn r32_a_true_list_is_not_called_false() {
    // The first impact lies in the bounds, the others come after what is certified.
    for list in ["time,wall\n0.29261231156811597,right\n", "time,wall\n0.293,right\n1.2,left\n"] {
        agreed(list, members().to_str().unwrap(), "1e-9");
    }
    // Impact 1 and one of the chatter after it (e = 5e-13), nearer to one another than the tolerance: the velocity tells which is which.
    let near = scene(
        "amplitude = [1, \"1/1000\"], frequency = [\"2*pi\", \"pi*(1+sqrt(5))\"], phase = 0",
        "gap = 1, restitution = \"[0, 1e-12]\"",
        "time = 0, position = \"1/2-1/10^8\", velocity = \"[-1/10^15, 1/10^15]\"",
    );
    let list = "time,wall,velocity\n\
                6.221933829007872356224058989805515835342e-4,right,4.821649576656871269925416466102019545134e-5\n\
                6.221933829010983327127703481944606869217e-4,right,2.410824788328837437548414355604186389487e-17\n";
    agreed(list, near.to_str().unwrap(), "1e-9");
    // `y = -3 + pi/6 + sqrt(3)/4 - t/4 - sin(t)/2` touches the left wall at 2 pi/3 with no velocity, and is next on it at the fast impact
    // listed, after which the ball rests: to the tolerance that impact is one with the end of its chatter, but no part of it.
    let grazes = scene(
        "amplitude = \"1/2\", frequency = 1, phase = 0",
        "gap = 6, restitution = 1e-30",
        "time = 0, position = \"-3+pi/6+sqrt(3)/4\", velocity = \"-3/4\"",
    );
    let list = "time,wall,velocity\n5.38759824288776744574270234604,left,-0.562530337867448180022265313677\n";
    for tolerance in ["1e-12", "1e-9", "1e-3"] {
        assert_eq!(agreed(list, grazes.to_str().unwrap(), tolerance)["counts"]["inside"], 1);
    }
}

/// The program's own lists of chatters: within the tolerance of the start and of the rest; faster than the tolerance, just before a rest.
#[test]
fn r32_impacts_of_a_chatter_within_the_tolerance_are_right() {
    let slow = scene(
        "amplitude = 1, frequency = \"2*pi\", phase = 0",
        "gap = 1, restitution = 0.2",
        "time = \"-1/4\", wall = \"left\", velocity = \"-5e-8\"",
    );
    let fast = scene(
        "amplitude = 0.184914855478891, frequency = \"2*pi\", phase = -0.9459879159136833",
        "gap = 1, restitution = 1.2045338356120227e-07",
        "time = 0, wall = \"right\", velocity = 1.073933065304292e-07",
    );
    for scene in [slow, fast] {
        let scene = scene.to_str().unwrap();
        let run = ["run", scene, "--impacts", "6", "--digits", "14", "--format", "json", "--quiet"];
        let list = String::from_utf8(program(&run).output().unwrap().stdout).unwrap();
        for tolerance in ["1e-9", "1e-6", "1e-3"] {
            agreed(&list, scene, tolerance);
        }
    }
}

/// Before the first contact that any member of the data has nothing is in doubt.
#[test]
fn r32_what_comes_before_all_that_may_happen_is_false() {
    let answer = answer("time,wall\n0.1,right\n", &[members().to_str().unwrap(), "-"]);
    let said = String::from_utf8(answer.stdout).unwrap() + &String::from_utf8(answer.stderr).unwrap();
    assert!(answer.status.code() == Some(1) && !said.contains("agreed: all"), "{said}");
}

/// With `e = 1` a ball that is pressed on a wall hops on it some 5e7 times before it leaves: none of these hops ends a chatter.
#[test]
fn r32_hops_without_end_are_not_followed_to_a_late_row() {
    let hops = scene(
        "amplitude = 0.1, frequency = \"2*pi\", phase = \"pi\"",
        "gap = 1, restitution = 1",
        "time = \"1/4\", position = \"-1/2+1/2^56\", velocity = \"0\"",
    );
    let document = judged("time,wall\n0.4,left\n", &[hops.to_str().unwrap(), "-"], 1);
    // 2^16 hops, a thousand, and two for the row.
    let said = "not followed beyond impact 66539: the list lacks more impacts than it has rows";
    assert!(document["message"].as_str().unwrap().ends_with(said), "{}", document["message"]);
    assert_eq!((&document["counts"]["not_reached"], &document["counts"]["missed"]), (&1.into(), &66539.into()));
}
