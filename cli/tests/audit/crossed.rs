//! Lists of motions next to rests, grazes and doubtful contacts: what is true is not called false.

use serde_json::Value;

use super::{answer, disagreements, judged};
use crate::common::program;

/// A scene of one harmonic with W = 2 pi and a gap of 1, in a file.
fn scene(amplitude: &str, restitution: &str, start: &str) -> tempfile::NamedTempFile {
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    let text = format!(
        "excitation = {{ amplitude = \"{amplitude}\", frequency = \"2*pi\", phase = 0 }}\n\
         pair = {{ gap = 1, restitution = \"{restitution}\" }}\nstart = {{ {start} }}"
    );
    std::fs::write(file.path(), text).unwrap();
    file
}

/// The list is the orbit of a member of the data (by `run --digits 14`: e = 1/2, v = 1.41): its first impact lies in the bounds, the
/// others come after what is certified.
#[test]
fn r32_a_member_of_the_data_is_not_called_false() {
    let scene = scene("0.1", "[0.1, 0.9]", "time = 0, position = 0, velocity = \"[1.4, 1.6]\"");
    let path = scene.path().to_str().unwrap();
    for list in ["time,wall\n0.29261231156811597,right\n", "time,wall\n0.293,right\n1.2,left\n"] {
        let answer = answer(list, &[path, "-", "--format", "json", "--quiet"]);
        let document: Value = serde_json::from_slice(&answer.stdout).unwrap();
        assert_eq!(disagreements(&document), [], "{document}");
    }
}

/// The program's own list of a chatter, whose first impacts are within the tolerance of the start and of the rest.
#[test]
fn r32_a_chatter_within_the_tolerance_of_its_start_is_right() {
    let scene = scene("1", "0.2", "time = \"-1/4\", wall = \"left\", velocity = \"-5e-8\"");
    let path = scene.path().to_str().unwrap();
    let list =
        program(&["run", path, "--impacts", "6", "--digits", "14", "--format", "json", "--quiet"]).output().unwrap();
    let document = judged(&String::from_utf8(list.stdout).unwrap(), &[path, "-"], 0);
    assert_eq!(disagreements(&document), []);
}

/// Before the first contact that any member of the data has nothing is in doubt.
#[test]
fn r32_what_comes_before_all_that_may_happen_is_false() {
    let scene = scene("0.1", "[0.1, 0.9]", "time = 0, position = 0, velocity = \"[1.4, 1.6]\"");
    let answer = answer("time,wall\n0.1,right\n", &[scene.path().to_str().unwrap(), "-"]);
    let said = String::from_utf8(answer.stdout).unwrap() + &String::from_utf8(answer.stderr).unwrap();
    assert!(answer.status.code() == Some(1) && !said.contains("agreed: all"), "{said}");
}

/// The program's own list: impacts of a chatter that ends within the tolerance, faster than the tolerance.
#[test]
fn r32_fast_impacts_just_before_a_rest_are_right() {
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    let text = "excitation = { amplitude = 0.184914855478891, frequency = \"2*pi\", phase = -0.9459879159136833 }\n\
                pair = { gap = 1, restitution = 1.2045338356120227e-07 }\n\
                start = { time = 0, wall = \"right\", velocity = 1.073933065304292e-07 }";
    std::fs::write(file.path(), text).unwrap();
    let path = file.path().to_str().unwrap();
    let list =
        program(&["run", path, "--impacts", "6", "--digits", "14", "--format", "json", "--quiet"]).output().unwrap();
    let list = String::from_utf8(list.stdout).unwrap();
    for tolerance in ["1e-9", "1e-6", "1e-3"] {
        let answer = answer(&list, &[path, "-", "--tolerance", tolerance, "--format", "json", "--quiet"]);
        let document: Value = serde_json::from_slice(&answer.stdout).unwrap();
        assert_eq!(disagreements(&document), [], "{document}");
    }
}

/// Impact 1 and one of the chatter after it (mpmath, for e = 5e-13), nearer to one another than the tolerance.
#[test]
fn r32_of_two_rows_within_the_tolerance_the_velocity_tells_which_is_the_impact() {
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    let text = "excitation = { amplitude = [1, \"1/1000\"], frequency = [\"2*pi\", \"pi*(1+sqrt(5))\"], phase = 0 }\n\
                pair = { gap = 1, restitution = \"[0, 1e-12]\" }\n\
                start = { time = 0, position = \"1/2-1/10^8\", velocity = \"[-1/10^15, 1/10^15]\" }";
    std::fs::write(file.path(), text).unwrap();
    let list = "time,wall,velocity\n\
                6.221933829007872356224058989805515835342e-4,right,4.821649576656871269925416466102019545134e-5\n\
                6.221933829010983327127703481944606869217e-4,right,2.410824788328837437548414355604186389487e-17\n";
    let answer = answer(list, &[file.path().to_str().unwrap(), "-", "--format", "json", "--quiet"]);
    let document: Value = serde_json::from_slice(&answer.stdout).unwrap();
    assert_eq!(disagreements(&document), [], "{document}");
}

/// `y = -3 + pi/6 + sqrt(3)/4 - t/4 - sin(t)/2` touches the left wall at 2 pi/3 with no velocity, and is next on it at the fast impact
/// listed (mpmath), after which the ball rests: to the tolerance that impact is one with the end of its chatter, but no part of it.
#[test]
fn r32_the_impact_after_a_graze_is_no_tail_of_a_chatter() {
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    let text = "excitation = { amplitude = \"1/2\", frequency = 1, phase = 0 }\n\
                pair = { gap = 6, restitution = 1e-30 }\n\
                start = { time = 0, position = \"-3+pi/6+sqrt(3)/4\", velocity = \"-3/4\" }";
    std::fs::write(file.path(), text).unwrap();
    let list = "time,wall,velocity\n5.38759824288776744574270234604,left,-0.562530337867448180022265313677\n";
    for tolerance in ["1e-12", "1e-9", "1e-3"] {
        let document = judged(list, &[file.path().to_str().unwrap(), "-", "--tolerance", tolerance], 0);
        assert_eq!(document["counts"]["inside"], 1, "{document}");
    }
}

/// With `e = 1` a ball that is pressed on a wall hops on it some 5e7 times before it leaves: none of these hops ends a chatter.
#[test]
fn r32_hops_without_end_are_not_followed_to_a_late_row() {
    let start = "time = \"1/4\", position = \"-1/2+1/2^56\", velocity = \"0\"";
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    let text = format!(
        "excitation = {{ amplitude = 0.1, frequency = \"2*pi\", phase = \"pi\" }}\n\
         pair = {{ gap = 1, restitution = 1 }}\nstart = {{ {start} }}"
    );
    std::fs::write(file.path(), text).unwrap();
    let document = judged("time,wall\n0.4,left\n", &[file.path().to_str().unwrap(), "-"], 1);
    // 2^16 hops, a thousand, and two for the row.
    let said = "not followed beyond impact 66539: the list lacks more impacts than it has rows";
    assert!(document["message"].as_str().unwrap().ends_with(said), "{}", document["message"]);
    assert_eq!((&document["counts"]["not_reached"], &document["counts"]["missed"]), (&1.into(), &66539.into()));
}
