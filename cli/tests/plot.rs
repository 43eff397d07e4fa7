//! `plot` on the command line: stdout, stderr and exit code together, and the file.

use crate::common;
use std::fs;
use std::process::Command;

use crate::common::{folder, verb};
use insta_cmd::assert_cmd_snapshot;

fn plot(arguments: &[&str]) -> Command {
    verb("plot", arguments)
}

#[test]
fn bad_questions_are_refused() {
    let scene = "scenes/figure-12.toml";
    assert_cmd_snapshot!("arguments_of_plot", plot(&["--help"]));
    assert_cmd_snapshot!("no_panel", plot(&[scene, "--output", "a.svg"]));
    assert_cmd_snapshot!("no_output", plot(&[scene, "--all"]));
    assert_cmd_snapshot!("no_such_panel", plot(&[scene, "--panel", "i", "--output", "a.svg"]));
    assert_cmd_snapshot!("no_cycles", plot(&[scene, "--all", "--cycles", "0", "--output", "a.svg"]));
    assert_cmd_snapshot!("one_and_all", plot(&[scene, "--all", "--panel", "a", "--output", "a.svg"]));
    assert_cmd_snapshot!("no_such_scene", plot(&["scenes/none.toml", "--all", "--output", "a.svg"]));
}

#[test]
fn other_endings_are_refused() {
    let scene = "scenes/figure-12.toml";
    #[cfg(not(any(feature = "png", feature = "pdf")))]
    for (name, file) in [("pdf", "a.pdf"), ("no_png", "a.png"), ("no_ending", "-"), ("another_ending", "a.eps")] {
        assert_cmd_snapshot!(name, plot(&[scene, "--all", "--output", file]));
    }
    assert_eq!(plot(&[scene, "--all", "--output", "a.eps"]).output().unwrap().status.code(), Some(2));
    assert_cmd_snapshot!("zoom_backwards", plot(&[scene, "--all", "--zoom", "2..1", "--output", "a.svg"]));
    assert_cmd_snapshot!("no_such_theme", plot(&[scene, "--all", "--theme", "grey", "--output", "a.svg"]));
}

#[test]
fn bad_input_writes_nothing() {
    let folder = folder("plot-bad");
    let (scene, picture) = (folder.join("scene.toml"), folder.join("a.svg"));
    fs::write(&scene, common::scene("figure-12.toml").replace("restitution = 0.5", "restitution = 2")).unwrap();
    let answer = plot(&[scene.to_str().unwrap(), "--all", "--output"]).arg(&picture).output().unwrap();
    assert_eq!(answer.status.code(), Some(2));
    assert!(String::from_utf8(answer.stderr).unwrap().contains("pair.restitution"));
    assert!(!picture.exists());
}

/// Lengths below and beyond the normal doubles, and a time at which doubles are further apart than impacts.
#[test]
fn what_doubles_do_not_resolve_is_not_drawn() {
    let folder = folder("plot-unresolved");
    let (scene, picture) = (folder.join("scene.toml"), folder.join("a.svg"));
    for (length, time) in [("1e-309", "0"), ("1e307", "0"), ("1", "1e17")] {
        let text = format!(
            "excitation = {{ amplitude = \"8*{length}\", frequency = \"pi\", phase = 0 }}\n\
             pair = {{ gap = \"9.42497*{length}\", restitution = 0.5 }}\n\
             start = {{ time = \"{time}\", wall = \"left\", velocity = \"-12.56636*{length}\" }}"
        );
        fs::write(&scene, text).unwrap();
        let answer = plot(&[scene.to_str().unwrap(), "--all", "--output"]).arg(&picture).output().unwrap();
        let said = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(2), "{said}");
        assert!(said.contains("the picture has an axis from") && !said.contains("panicked"), "{said}");
        assert!(!picture.exists());
    }
    let one_double =
        ["scenes/figure-14.toml", "--over", "gap=3..3.00000000000000000001:3", "--impacts", "10", "--plot"];
    let answer = verb("sweep", &one_double).arg(&picture).output().unwrap();
    let said = String::from_utf8(answer.stderr).unwrap();
    assert!(answer.status.code() == Some(2) && said.contains("the picture has an axis from 3e0 to 3e0"), "{said}");
}

#[test]
fn motions_without_impacts_are_drawn() {
    let folder = folder("plot-still");
    let still = "excitation = { amplitude = 0, frequency = 1, phase = 0 }\npair = { gap = 1, restitution = 0.5 }\n";
    for start in ["wall = \"left\", velocity = 0", "position = 0, velocity = 0"] {
        let (scene, picture) = (folder.join("scene.toml"), folder.join("a.svg"));
        fs::write(&scene, format!("{still}start = {{ time = 0, {start} }}\n")).unwrap();
        let answer = plot(&[scene.to_str().unwrap(), "--all", "--output"]).arg(&picture).output().unwrap();
        assert!(answer.status.success(), "{start}: {answer:?}");
        assert!(fs::read_to_string(&picture).unwrap().contains("(h) "));
    }
}

#[test]
fn floating_point_claims_nothing() {
    let folder = folder("plot-float");
    let picture = folder.join("a.svg");
    let arguments = ["scenes/figure-14.toml", "--panel", "time", "--output"];
    assert_eq!(plot(&arguments).arg(&picture).output().unwrap().status.code(), Some(2));
    let arguments = ["scenes/figure-14.toml", "--panel", "velocity", "--arithmetic", "float", "--output"];
    let answer = plot(&arguments).arg(&picture).output().unwrap();
    assert!(answer.status.success(), "{answer:?}");
    let svg = fs::read_to_string(&picture).unwrap();
    assert!(svg.contains("motion, not certified") && svg.contains("computed, not certified: "));
    assert!(!svg.contains("#0072B2"), "the colour of what is certified");
}

#[test]
fn a_dark_picture_has_the_same_words_and_another_ground() {
    let folder = folder("plot-dark");
    let drawn = |theme: &str| {
        let picture = folder.join(format!("{theme}.svg"));
        let arguments = ["scenes/figure-13.toml", "--panel", "c", "--transient", "4", "--theme", theme, "--output"];
        assert!(plot(&arguments).arg(&picture).output().unwrap().status.success());
        fs::read_to_string(picture).unwrap()
    };
    let (light, dark) = (drawn("light"), drawn("dark"));
    assert!(light.contains("fill=\"#FFFFFF\"") && !dark.contains("#FFFFFF") && dark.contains("fill=\"#121212\""));
    assert!(light.len() == dark.len() && dark.contains("transient: the first 4 impacts"));
}

#[cfg(feature = "pdf")]
#[test]
fn a_pdf_has_its_letters_and_its_curves() {
    let picture = folder("plot-pdf").join("a.pdf");
    let answer = plot(&["scenes/figure-12.toml", "--panel", "c", "--output"]).arg(&picture).output().unwrap();
    assert!(answer.status.success(), "{answer:?}");
    let pdf = fs::read(&picture).unwrap();
    let holds = |words: &[u8]| pdf.windows(words.len()).any(|part| part == words);
    assert!(
        pdf.starts_with(b"%PDF-")
            && holds(b"DejaVuSans")
            && holds(b"DejaVuSans-Oblique")
            && !holds(b"/Subtype/Image")
            && !holds(b"/Subtype /Image")
    );
}

#[cfg(feature = "png")]
#[test]
fn a_png_is_the_same_drawing_with_words() {
    let folder = folder("plot-png");
    let draw = |ending: &str| {
        let picture = folder.join(format!("a.{ending}"));
        let answer = plot(&["scenes/figure-12.toml", "--panel", "c", "--output"]).arg(&picture).output().unwrap();
        assert!(answer.status.success(), "{answer:?}");
        fs::read(picture).unwrap()
    };
    let (svg, png) = (String::from_utf8(draw("svg")).unwrap(), draw("png"));
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    let size = |from: usize| u32::from_be_bytes(png[from..from + 4].try_into().unwrap());
    let head = format!("<svg width=\"{}\" height=\"{}\"", size(16) / 2, size(20) / 2);
    assert!(svg.starts_with(&head), "{head}");
    // Without its words the picture would be a good deal smaller.
    assert!(png.len() > 20_000, "{}", png.len());
}
