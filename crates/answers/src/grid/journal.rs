//! The points that are finished, on disk: a head, then a record a line, in the order in which they were finished.
//!
//! A journal beside the output outlives the program. Each of its lines begins with a checksum, so that a damaged one is refused;
//! a last line that a crash has torn is forgotten. A shard is a journal as well, without checksums.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use super::head::{Head, Line};
use super::record::{is_of_grid, line, own, read_head};

/// Bytes before the text of a line: its CRC-32 in hexadecimal digits, and a blank.
const CHECKSUM_BYTES: usize = 9;

/// The text of a line, if it is what was written.
fn unsealed(line: &[u8]) -> Result<&[u8]> {
    if line.starts_with(b"{") {
        bail!("it has no checksum: an earlier version started this sweep; remove the file to start again");
    }
    let text = line.get(CHECKSUM_BYTES..).unwrap_or_default();
    if line.get(..CHECKSUM_BYTES) != Some(format!("{:08x} ", crc32fast::hash(text)).as_bytes()) {
        bail!("it is corrupted: its checksum does not match its content");
    }
    Ok(text)
}

/// The position of the record of a point.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Number of the file.
    file: usize,
    offset: u64,
    bytes: usize,
}

/// Finished points: their records in a file, or those of shards in several, and where each of them is.
pub struct Points<H: Head> {
    /// All that the points depend on.
    pub head: H,
    files: Vec<File>,
    places: BTreeMap<u64, Place>,
    /// Bytes of the first file, to which points are added.
    end: u64,
    /// Beside an output; otherwise it is gone with the program.
    path: Option<PathBuf>,
}

/// The name of the journal of an output that is a file to be.
pub fn beside(output: &Path) -> Option<PathBuf> {
    // Nothing is put beside a device, or a pipe.
    let is_special = fs::metadata(output).is_ok_and(|existing| !existing.is_file());
    if output.as_os_str() == "-" || is_special {
        return None;
    }
    // A link stands for what it points at, as for the output itself.
    let mut name = OsString::from(fs::canonicalize(output).unwrap_or_else(|_| output.to_owned()));
    name.push(".partial");
    Some(name.into())
}

impl<H: Head> Points<H> {
    /// Points in a new journal beside an output, or to `resume` in that of an earlier sweep or atlas into the same output.
    ///
    /// # Errors
    /// If there is a journal that is not to be resumed, or as of [`Points::kept`].
    pub fn open(head: H, output: Option<&Path>, resume: bool) -> Result<Self> {
        let path = output.and_then(beside);
        if let Some(path) = path.as_ref().filter(|path| path.exists() && !resume) {
            let shown = path.display();
            bail!("{shown} holds an unfinished {}: continue it with --resume, or remove the file", H::NAME);
        }
        Self::kept(head, path)
    }

    /// Points in a file, a new one where there is none; without a path in one that is gone with the program.
    ///
    /// # Errors
    /// If the file cannot be written, is damaged, or belongs to another sweep or atlas.
    pub fn kept(head: H, path: Option<PathBuf>) -> Result<Self> {
        let Some(path) = path else {
            return Self::begin(head, tempfile::tempfile().context("cannot open a temporary file")?, None);
        };
        let shown = path.display().to_string();
        if path.exists() {
            let file = OpenOptions::new().read(true).write(true).open(&path);
            let file = file.with_context(|| format!("cannot open {shown}"))?;
            return Self::resumed(head, file, path).with_context(|| shown.clone());
        }
        let file = OpenOptions::new().read(true).write(true).create_new(true).open(&path);
        Self::begin(head, file.with_context(|| format!("cannot write {shown}"))?, Some(path))
    }

    /// A new journal.
    fn begin(head: H, file: File, path: Option<PathBuf>) -> Result<Self> {
        let line = line(&head);
        let mut journal = Self { head, files: vec![file], places: BTreeMap::new(), end: 0, path };
        journal.write(&line).with_context(|| format!("cannot write the head of the {}", H::NAME))?;
        Ok(journal)
    }

    /// An earlier journal, which must be about the same; a torn end is cut off.
    fn resumed(head: H, file: File, path: PathBuf) -> Result<Self> {
        if file.metadata()?.len() == 0 {
            return Self::begin(head, file, Some(path));
        }
        let found = Self::scan(file, true)?;
        if found.head != head {
            bail!("it belongs to another {} or another version: {}", H::NAME, difference(&found.head, &head));
        }
        found.files[0].set_len(found.end).context("cannot remove the incomplete last line")?;
        Ok(Self { path: Some(path), ..found })
    }

    /// A shard, as it was written.
    pub(super) fn read(path: &Path) -> Result<Self> {
        let shown = path.display().to_string();
        let file = File::open(path).with_context(|| format!("cannot read {shown}"))?;
        Self::scan(file, false).context(shown)
    }

    /// Reads all of a file. Of a journal beside an output each line has a checksum, and one that does not end is what a crash
    /// has torn.
    fn scan(file: File, is_partial: bool) -> Result<Self> {
        let mut lines = BufReader::new(file);
        let (mut places, mut end, mut bytes, mut head) = (BTreeMap::new(), 0, Vec::new(), None);
        for number in 1u64.. {
            bytes.clear();
            lines.read_until(b'\n', &mut bytes).with_context(|| format!("line {number}"))?;
            if head.is_some() && (bytes.is_empty() || (is_partial && !bytes.ends_with(b"\n"))) {
                break;
            }
            let all = bytes.len() as u64;
            let written = bytes.trim_ascii_end();
            let text = if is_partial { unsealed(written).with_context(|| format!("line {number}"))? } else { written };
            let place = Place { file: 0, offset: end + (written.len() - text.len()) as u64, bytes: text.len() };
            end += all;
            let text = std::str::from_utf8(text).with_context(|| format!("line {number}"))?;
            let Some((head, grid)) = &head else {
                head = Some(read_head::<H>(text)?);
                continue;
            };
            let record: H::Record =
                serde_json::from_str(text).with_context(|| format!("line {number} is not the record of a point"))?;
            let point = record.point();
            if !head.has(point) {
                bail!("line {number}: point {point} does not belong to this {} or shard", H::NAME);
            }
            if !is_of_grid::<H>(&record, grid) {
                let values = record.values().join(", ");
                bail!("line {number}: the values of point {point} are {values}, which is not its place in the grid");
            }
            if places.insert(point, place).is_some() {
                bail!("line {number}: point {point} occurs twice");
            }
        }
        let (head, _) = head.context("line 1 is missing")?;
        Ok(Self { head, files: vec![lines.into_inner()], places, end, path: None })
    }

    /// Number of points.
    pub fn count(&self) -> u64 {
        self.places.len() as u64
    }

    /// The points of the grid, or of the shard, that are not there.
    pub fn missing(&self) -> Vec<u64> {
        own(&self.head).filter(|point| !self.places.contains_key(point)).collect()
    }

    /// Adds the records of points that were computed elsewhere, a line each.
    ///
    /// # Errors
    /// If a line is no record of a point that is missing, or cannot be written.
    pub fn add_lines(&mut self, lines: &str) -> Result<()> {
        for line in lines.lines() {
            let record: H::Record = serde_json::from_str(line).context("a line is not the record of a point")?;
            let point = record.point();
            if !self.head.has(point) || self.places.contains_key(&point) {
                bail!("point {point} does not belong to this {}, or is there already", H::NAME);
            }
            self.add(point, line).context("cannot write a finished point")?;
        }
        Ok(())
    }

    /// Adds the record of a point; from now on a crash does not lose it.
    pub(super) fn add(&mut self, point: u64, line: &str) -> io::Result<()> {
        let place = Place { file: 0, offset: self.end + CHECKSUM_BYTES as u64, bytes: line.len() };
        self.write(line)?;
        self.places.insert(point, place);
        Ok(())
    }

    fn write(&mut self, line: &str) -> io::Result<()> {
        self.files[0].seek(SeekFrom::Start(self.end))?;
        let text = format!("{:08x} {line}\n", crc32fast::hash(line.as_bytes()));
        self.files[0].write_all(text.as_bytes())?;
        self.end += text.len() as u64;
        Ok(())
    }

    /// Hands on the lines of the points that are there, in order.
    ///
    /// # Errors
    /// Those of `hand`, and if a line cannot be read.
    pub fn each(&mut self, hand: impl FnMut(&str) -> Result<()>) -> Result<()> {
        self.each_of(0..self.head.points(), hand)
    }

    /// Hands on the lines of those of some points that are there, in order.
    ///
    /// # Errors
    /// As of [`Points::each`].
    pub fn each_of(&mut self, points: Range<u64>, mut hand: impl FnMut(&str) -> Result<()>) -> Result<()> {
        for (_, Place { file, offset, bytes }) in self.places.range(points) {
            let file = &mut self.files[*file];
            file.seek(SeekFrom::Start(*offset))?;
            let mut line = vec![0; *bytes];
            file.read_exact(&mut line).context("cannot read back a finished point")?;
            hand(str::from_utf8(&line)?)?;
        }
        Ok(())
    }

    /// Hands on the records of the points that are there, in order.
    ///
    /// # Errors
    /// Those of `hand`, and if a record cannot be read.
    pub fn each_record(&mut self, mut hand: impl FnMut(H::Record) -> Result<()>) -> Result<()> {
        self.each(|text| hand(serde_json::from_str(text)?))
    }

    /// Takes in the points of another shard.
    pub(super) fn append(&mut self, shard: Self) {
        let file = self.files.len();
        self.files.extend(shard.files);
        self.places.extend(shard.places.into_iter().map(|(point, place)| (point, Place { file, ..place })));
    }

    /// The path at which the points remain after the program ends; `None` if there is none.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Removes the journal: the output is there.
    ///
    /// # Errors
    /// If the file cannot be removed.
    pub fn finish(self) -> Result<()> {
        match &self.path {
            Some(path) => fs::remove_file(path).with_context(|| format!("cannot remove {}", path.display())),
            None => Ok(()),
        }
    }
}

/// The first thing that two heads differ in.
pub fn difference<H: Head>(one: &H, other: &H) -> String {
    let entries = |head: &H| match serde_json::to_value(head) {
        Ok(serde_json::Value::Object(entries)) => entries,
        _ => serde_json::Map::new(),
    };
    let (one, other) = (entries(one), entries(other));
    let keys = one.keys().chain(other.keys());
    let null = serde_json::Value::Null;
    let get = |entries: &serde_json::Map<_, _>, key: &String| entries.get(key).unwrap_or(&null).clone();
    let differ = keys.map(|key| (key, get(&one, key), get(&other, key))).find(|(_, a, b)| a != b);
    differ.map_or_else(String::new, |(key, a, b)| format!("{key} is {a} in one and {b} in the other"))
}
