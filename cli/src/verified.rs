//! `impact-pair check --verified DOCUMENT`: the checker extracted from its proof in Coq, a program of its own.

use std::env;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output as Answered, Stdio};

use anyhow::{Context, Result, anyhow, bail};
use impact_pair::json::{VERIFIED_SCHEMA, VerifiedDocument, one_a_line};
use sha2::{Digest, Sha256};

use crate::Answer;
use crate::output::Output;
use crate::scene;

/// The program, which `validation/coq/verified/build` builds.
const PROGRAM: &str = "impact-pair-verified";
/// The beginning of its last line where it does not verify a document; the reason follows.
const NOT_VERIFIED: &str = "not verified: ";

/// Writes the claim of a document and the verdict of the verified checker.
pub fn verify(path: &Path, is_json: bool, output: Option<&Path>) -> Result<Answer> {
    let text = scene::text(path)?;
    scene::keep(path, output)?;
    let answered = answer(&program()?, &text)?;
    let said = String::from_utf8_lossy(&answered.stdout);
    let written = |reason: Option<&str>| match is_json {
        false => said.clone().into_owned(),
        true => one_a_line(&document(&text, &said, reason), &[]) + "\n",
    };
    // Its exit code and its last line have to say the same.
    match (answered.status.code(), said.lines().last()) {
        (Some(0), Some("verified")) => write(&written(None), output, Answer::Complete),
        (Some(1), Some(last)) if last.starts_with(NOT_VERIFIED) => {
            write(&written(last.strip_prefix(NOT_VERIFIED)), output, Answer::Incomplete)
        }
        (Some(2), Some(last)) if last.starts_with("unreadable: ") => Err(anyhow!("{last}").context(scene::name(path))),
        _ => {
            let complaint = String::from_utf8_lossy(&answered.stderr);
            let stopped = format!("{PROGRAM} stopped without a verdict, {}\n{complaint}", answered.status);
            Err(anyhow!("{}", stopped.trim()).context(scene::name(path)))
        }
    }
}

/// The name of a document: SHA-256 in hexadecimal.
pub fn sha256(text: &str) -> String {
    format!("{:x}", Sha256::digest(text.as_bytes()))
}

/// The answer of the program as a document.
fn document(text: &str, said: &str, reason: Option<&str>) -> VerifiedDocument {
    let line = |key: &str| said.lines().find_map(|line| line.strip_prefix(key)).map(str::to_owned);
    VerifiedDocument {
        schema: VERIFIED_SCHEMA.to_owned(),
        verified: reason.is_none(),
        claim: line("claim: "),
        scene: line("scene: "),
        sha256: sha256(text),
        reason: reason.map(str::to_owned),
    }
}

fn write(said: &str, output: Option<&Path>, answer: Answer) -> Result<Answer> {
    let mut out = Output::open(output)?;
    out.write_all(said.as_bytes()).context("cannot write the output")?;
    out.commit()?;
    Ok(answer)
}

/// Returns the output of the verified checker `program` for the certificate `text`.
fn answer(program: &Path, text: &str) -> Result<Answered> {
    let run = || {
        let mut child = Command::new(program)
            .arg("-")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        // It answers only after it has read all.
        child.stdin.take().map(|mut input| input.write_all(text.as_bytes())).transpose()?;
        child.wait_with_output()
    };
    run().with_context(|| format!("cannot run {}", program.display()))
}

/// The program beside this one, or else on PATH.
fn program() -> Result<PathBuf> {
    let name = format!("{PROGRAM}{}", env::consts::EXE_SUFFIX);
    let beside = env::current_exe().ok().and_then(|this| this.parent().map(Path::to_owned));
    let path = env::var_os("PATH").unwrap_or_default();
    let found =
        beside.into_iter().chain(env::split_paths(&path)).map(|folder| folder.join(&name)).find(|file| file.is_file());
    let Some(found) = found else {
        bail!("{PROGRAM} is neither beside impact-pair nor on PATH: validation/coq/verified/build builds it");
    };
    Ok(found)
}
