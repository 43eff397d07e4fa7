//! Lists in text: CSV, TSV, semicolons or blanks between columns, with a header, a commented one, or none.

use std::collections::BTreeSet;

use csv::{ReaderBuilder, StringRecord, Trim};

use super::{Column, Columns, List, Listed, Number, Walls, is_impact_name, read_wall, refused, shortened};
use crate::Error;

/// Lines that begin so are no data.
const COMMENT_SIGNS: [char; 2] = ['#', '%'];

pub(super) fn read(text: &str, columns: &Columns, walls: &Walls) -> Result<List, Error> {
    let mut comment = None;
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim())).filter(|(_, line)| !line.is_empty());
    let first = lines.by_ref().find(|(_, line)| {
        let said = line.strip_prefix(COMMENT_SIGNS);
        comment = said.or(comment);
        said.is_none()
    });
    let Some((number, first)) = first else { refuse!("the list has no events: accepted is at least one") };
    let separator = Separator::of(first);
    let fields = separator.fields(first);
    let is_header = fields.iter().all(|field| field.parse::<f64>().is_err());
    let header = match is_header {
        true => Header::Line(fields.clone()),
        false => Header::of_comment(comment, &separator, fields.len()),
    };
    let places = Places::find(columns, &header, fields.len())?;
    let data = lines.filter(|(_, line)| !line.starts_with(COMMENT_SIGNS));
    let is_impact =
        |fields: &[String]| places.event.and_then(|at| fields.get(at)).is_none_or(|event| is_impact_name(event));
    let data = (!is_header).then_some((number, first)).into_iter().chain(data);
    let rows = data.map(|(number, line)| (number, separator.fields(line))).filter(|(_, fields)| is_impact(fields));
    let read = |(at, row): (usize, Vec<String>)| {
        none_beyond((at, &row), (number, fields.len()))?;
        places.row(at, &row, walls)
    };
    let rows: Vec<Listed> = rows.map(read).collect::<Result<_, _>>()?;
    if rows.is_empty() {
        refuse!("the list has no events below its header: accepted is at least one");
    }
    let unused = places.unused(&header, fields.len());
    Ok(List { rows, unused, velocities: columns.velocity.is_some() })
}

/// Refuses a row with a value after the last column of the first line: nothing says what it is, nor whether the columns before are shifted.
fn none_beyond((at, row): (usize, &[String]), (first, width): (usize, usize)) -> Result<(), Error> {
    match row.iter().rposition(|field| !field.is_empty()) {
        Some(last) if last >= width => {
            let written = shortened(&row.join(" "));
            refuse!("line {at} is `{written}`, with {} columns, but line {first} has {width}", last + 1)
        }
        _ => Ok(()),
    }
}

/// The separator of columns.
enum Separator {
    Byte(u8),
    Blanks,
}

impl Separator {
    fn of(line: &str) -> Self {
        let byte = [';', '\t', ','].into_iter().find(|&byte| line.contains(byte));
        byte.map_or(Self::Blanks, |byte| Self::Byte(byte as u8)) // exact: ASCII
    }

    fn fields(&self, line: &str) -> Vec<String> {
        let &Self::Byte(byte) = self else { return line.split_whitespace().map(str::to_owned).collect() };
        // Only quotes need a reader of their own: to make one takes longer than a hundred lines.
        if !line.contains('"') {
            return line.split(char::from(byte)).map(|field| field.trim().to_owned()).collect();
        }
        let mut reader = ReaderBuilder::new();
        reader.has_headers(false).delimiter(byte).trim(Trim::All).flexible(true);
        let mut record = StringRecord::new();
        // A line in memory: nothing can fail, and it is not empty.
        let _ = reader.from_reader(line.as_bytes()).read_record(&mut record);
        // A quote after a blank is none to it.
        record.iter().map(|field| field.trim_matches('"').to_owned()).collect()
    }
}

/// The names of the columns.
enum Header {
    Line(Vec<String>),
    /// The last comment before the data, as `numpy.savetxt` writes it: a name for each column.
    Comment(Vec<String>),
    None,
}

impl Header {
    /// A comment of another number of words says something else.
    fn of_comment(comment: Option<&str>, separator: &Separator, width: usize) -> Self {
        let names = comment.map(|comment| separator.fields(comment.trim_start_matches(COMMENT_SIGNS).trim()));
        names.filter(|names| names.len() == width).map_or(Self::None, Self::Comment)
    }

    fn names(&self) -> &[String] {
        match self {
            Self::Line(names) | Self::Comment(names) => names,
            Self::None => &[],
        }
    }
}

/// The columns of a number: one column, or those of its lower and upper bound.
#[derive(Clone, Copy)]
struct Place {
    lower: usize,
    upper: usize,
}

/// The columns of each quantity.
struct Places {
    event: Option<usize>,
    time: Place,
    wall: usize,
    velocity: Option<Place>,
}

impl Places {
    fn find(columns: &Columns, header: &Header, width: usize) -> Result<Self, Error> {
        let one = |at: usize| Place { lower: at, upper: at };
        let number = |column: &Column, usual| match bounds(column, header) {
            Some(place) => Ok(place),
            None => find(column, header, width, usual).map(one),
        };
        let (time, wall) = (number(&columns.time, 0)?, find(&columns.wall, header, width, 1)?);
        let velocity = match &columns.velocity {
            None => None,
            Some(column) if column.given.is_some() => Some(one(find(column, header, width, 2)?)),
            Some(column) => match (named(column.names, header), header) {
                (Some(at), _) => Some(one(at)),
                (None, Header::Line(_)) => bounds(column, header),
                (None, _) => (width > 2 && time.lower != 2 && wall != 2).then_some(one(2)),
            },
        };
        Ok(Self { event: named(&["event"], header), time, wall, velocity })
    }

    /// The names of the columns that are in none of them.
    fn unused(&self, header: &Header, width: usize) -> Vec<String> {
        let names = header.names();
        let ends = |place: Place| [place.lower, place.upper];
        let read: BTreeSet<usize> = [Some(self.time), self.velocity]
            .into_iter()
            .flatten()
            .flat_map(ends)
            .chain([self.wall])
            .chain(self.event)
            .collect();
        let name = |at: usize| match names.get(at) {
            Some(name) if !name.is_empty() => shortened(name),
            _ => format!("column {}", at + 1),
        };
        // exact: columns of the header, or of the first row
        (0..width.max(names.len())).filter(|at| !read.contains(at)).map(name).collect()
    }

    fn row(&self, number: usize, fields: &[String], walls: &Walls) -> Result<Listed, Error> {
        let field = |name: &str, place: usize| match fields.get(place) {
            Some(field) => Ok(field.as_str()),
            None => {
                refuse!("line {number} is `{}`, but {name} is in column {}", shortened(&fields.join(" ")), place + 1)
            }
        };
        let place = format!("line {number}");
        let decimal = |name: &str, at: usize| {
            let text = field(name, at)?;
            Number::decimal(text).ok_or_else(|| refused(&place, name, text, "a finite decimal number"))
        };
        let between = |name: &str, Place { lower, upper }: Place| {
            let bounds = [decimal(name, lower)?, decimal(name, upper)?];
            let written = bounds[0].written.clone();
            Number::between(bounds)
                .ok_or_else(|| refused(&place, name, &written, "a lower bound that is no greater than the upper one"))
        };
        let is_there = |at: &Place| fields.get(at.lower).is_none_or(|text| !text.is_empty());
        let time = between("time", self.time)?;
        let wall = read_wall(&place, field("wall", self.wall)?, walls)?;
        let velocity = self.velocity.filter(is_there).map(|at| between("velocity", at)).transpose()?;
        Ok(Listed { place, wall, time, velocity })
    }
}

/// The place of a column: by the name or the number given, by its usual names, or where it stands if there is no header.
fn find(column: &Column, header: &Header, width: usize, usual: usize) -> Result<usize, Error> {
    let Column { flag, names, given } = column;
    let Some(given) = given else {
        return match (named(names, header), header) {
            (Some(place), _) => Ok(place),
            (None, Header::Line(header)) => refuse!(
                "the header `{}` has no column {}: say which one it is by {flag} NAME or {flag} NUMBER",
                shortened(&header.join(",")),
                names.join(" or "),
            ),
            (None, _) => Ok(usual),
        };
    };
    let number = given.parse().ok().filter(|number| (1..=width).contains(number));
    match named(&[given.as_str()], header).or(number.map(|number: usize| number - 1)) {
        Some(place) => Ok(place),
        None => {
            let names = header.names();
            let names = if names.is_empty() { String::new() } else { format!("one of {} or ", names.join(", ")) };
            refuse!("{flag} is `{}`, but accepted is {names}a number from 1 to {width}", shortened(given))
        }
    }
}

/// The two columns of bounds that a column may be, as `run --format csv` writes them.
fn bounds(column: &Column, header: &Header) -> Option<Place> {
    if column.given.is_some() || named(column.names, header).is_some() {
        return None;
    }
    let end = |end: &str| {
        let names = column.names.iter().map(|name| format!("{name}_{end}"));
        names.into_iter().find_map(|name| named(&[&name], header))
    };
    Some(Place { lower: end("lower")?, upper: end("upper")? })
}

fn named(names: &[&str], header: &Header) -> Option<usize> {
    names.iter().find_map(|name| header.names().iter().position(|known| name.eq_ignore_ascii_case(known)))
}
