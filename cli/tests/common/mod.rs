//! The program, its scenes, and what it writes.

#![allow(dead_code, reason = "not every test file needs all")]

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::{fs, io};

/// `impact-pair run` with these arguments, in the root of the repository.
pub fn run(arguments: &[&str]) -> Command {
    verb("run", arguments)
}

/// A verb with these arguments, in the root of the repository.
pub fn verb(name: &str, arguments: &[&str]) -> Command {
    program(&[&[name], arguments].concat())
}

/// A test for each command: stdout, stderr and exit code as they were recorded, but for what the filters cut out.
macro_rules! snapshots {
    ($filters:expr; $($name:ident: $command:expr;)*) => {
        $(#[test]
        fn $name() {
            insta::with_settings!({ filters => $filters.to_vec() }, {
                insta_cmd::assert_cmd_snapshot!(stringify!($name), $command);
            });
        })*
    };
}
pub(crate) use snapshots;

/// No filter of snapshots.
pub const EXACT: [(&str, &str); 0] = [];
/// Bounds depend on how well the arithmetic rounds: only certain digits are compared.
pub const UNCERTAIN: [(&str, &str); 2] = [(r"\([-+]?\d+,[-+]?\d+\) *", "(..) "), (r"(\d\.\d{5})\d+", "$1..")];

/// `impact-pair` with these arguments, in the root of the repository, without colour.
pub fn program(arguments: &[&str]) -> Command {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the crate lies in the workspace");
    let mut command = Command::new(env!("CARGO_BIN_EXE_impact-pair"));
    command.args(arguments).current_dir(root).env("NO_COLOR", "1");
    command
}

/// The output of `run` for a scene on stdin.
pub fn answer_to(scene: &str, arguments: &[&str]) -> Output {
    answer_of(scene, &[&["run", "-"], arguments].concat())
}

/// The output of the program with these arguments, for a text on stdin.
pub fn answer_of(text: &str, arguments: &[&str]) -> Output {
    use std::io::Write;
    let mut command = program(arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the program starts");
    child.stdin.take().expect("a pipe").write_all(text.as_bytes()).expect("the program reads");
    child.wait_with_output().expect("the program ends")
}

/// The text of a scene of the repository.
pub fn scene(name: &str) -> String {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "..", "scenes", name].iter().collect();
    std::fs::read_to_string(path).expect("a scene of the repository")
}

/// An empty folder of one test.
pub fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// A picture whose words are in one piece: without the spans of subscripts and slanted letters.
pub fn words(svg: &str) -> String {
    let mut parts = svg.replace("</tspan>", "").split("<tspan").map(str::to_owned).collect::<Vec<_>>();
    for part in parts.iter_mut().skip(1) {
        *part = part.split_once('>').unwrap().1.to_owned();
    }
    parts.concat()
}

/// CRC-32 bit by bit, as IEEE 802.3 has it.
pub fn crc(bytes: &[u8]) -> u32 {
    let shift = |crc: u32, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), shift))
}

/// The names of what is in a folder, in order.
pub fn files(folder: &Path) -> Vec<String> {
    let file = |file: io::Result<fs::DirEntry>| file.unwrap().file_name().into_string().unwrap();
    let mut names: Vec<_> = fs::read_dir(folder).unwrap().map(file).collect();
    names.sort();
    names
}

/// The output of a command that is interrupted (Ctrl-C) as soon as it `is_ready`.
#[cfg(unix)]
pub fn interrupted(command: &mut Command, is_ready: impl Fn() -> bool) -> Output {
    let child = command.stderr(Stdio::piped()).spawn().unwrap();
    while !is_ready() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    interrupt(&child);
    child.wait_with_output().unwrap()
}

/// Returns the output of a command that is interrupted (Ctrl-C) at work: after it `is_ready`, later from one try to the next,
/// until the output `is_within`. Machines and builds differ by more than any one wait allows for.
#[cfg(unix)]
pub fn interrupted_within(
    command: impl Fn() -> Command,
    is_ready: impl Fn() -> bool,
    is_within: impl Fn(&Output) -> bool,
) -> Output {
    let after = |wait| {
        let mut child = command().stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        while !is_ready() {
            assert!(child.try_wait().unwrap().is_none(), "it is never ready");
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        std::thread::sleep(wait);
        interrupt(&child);
        child.wait_with_output().unwrap()
    };
    let waits = (5..14).map(|power| std::time::Duration::from_millis(1 << power));
    waits.map(after).find(is_within).expect("an answer within the work")
}

/// Ctrl-C.
#[cfg(unix)]
pub fn interrupt(child: &Child) {
    nix::sys::signal::kill(nix::unistd::Pid::from_raw(child.id() as i32), nix::sys::signal::Signal::SIGINT).unwrap();
}
