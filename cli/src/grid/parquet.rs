//! A table of a sweep or an atlas as Apache Parquet: its columns, bounds as doubles rounded outward.

use std::sync::Arc;

use anyhow::{Context, Error, Result};
use impact_pair_answers::grid::{Cell, Head, Kind, Points, doubles, line};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::parser::parse_message_type;

use crate::output::Output;

/// Rows that are kept in memory and written as one group.
const ROW_GROUP_SIZE: usize = 1 << 16;

/// A column of a group: for each row its value, if it has one.
enum Column {
    Whole(Vec<Option<i64>>),
    Text(Vec<Option<ByteArray>>),
    Truth(Vec<Option<bool>>),
    Number(Vec<Option<f64>>),
    /// Lower and upper bounds.
    Bounds([Vec<Option<f64>>; 2]),
}

/// Writes a table; the head, as JSON, stands in the file's metadata under `impact-pair/sweep` or `impact-pair/atlas`.
pub fn write<H: Head>(points: &mut Points<H>, out: &mut Output, table: H::Table) -> Result<()> {
    let head = points.head.clone();
    let columns = head.columns(table);
    let schema = parse_message_type(&schema(&columns)).context("the columns make no schema")?;
    let about = KeyValue::new(format!("impact-pair/{}", H::NAME), line(&head));
    let properties = WriterProperties::builder().set_key_value_metadata(Some(vec![about])).build();
    let mut writer = SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties))?;
    let kinds: Vec<Kind> = columns.iter().map(|(_, kind)| *kind).collect();
    let mut group = Group::new(&kinds);
    points.each_record(|record| {
        for row in head.rows(table, &record) {
            group.push(&row, &kinds)?;
            if group.rows == ROW_GROUP_SIZE {
                std::mem::replace(&mut group, Group::new(&kinds)).write(writer.next_row_group()?)?;
            }
        }
        Ok(())
    })?;
    if group.rows > 0 {
        group.write(writer.next_row_group()?)?;
    }
    writer.close()?;
    Ok(())
}

/// The schema as Parquet's own words have it.
fn schema(columns: &[(String, Kind)]) -> String {
    let column = |(name, kind): &(String, Kind)| match kind {
        Kind::Whole => format!("OPTIONAL INT64 {name};"),
        Kind::Text => format!("OPTIONAL BYTE_ARRAY {name} (UTF8);"),
        Kind::Truth => format!("OPTIONAL BOOLEAN {name};"),
        Kind::Low | Kind::High | Kind::Number => format!("OPTIONAL DOUBLE {name};"),
        Kind::Exact | Kind::Bounds => format!("OPTIONAL DOUBLE {name}_lower; OPTIONAL DOUBLE {name}_upper;"),
    };
    let columns: String = columns.iter().map(column).collect();
    format!("message points {{ {columns} }}")
}

/// Rows that are written together.
struct Group {
    columns: Vec<Column>,
    rows: usize,
}

impl Group {
    fn new(kinds: &[Kind]) -> Self {
        let column = |kind: &Kind| match kind {
            Kind::Whole => Column::Whole(Vec::new()),
            Kind::Text => Column::Text(Vec::new()),
            Kind::Truth => Column::Truth(Vec::new()),
            Kind::Low | Kind::High | Kind::Number => Column::Number(Vec::new()),
            Kind::Exact | Kind::Bounds => Column::Bounds([Vec::new(), Vec::new()]),
        };
        Self { columns: kinds.iter().map(column).collect(), rows: 0 }
    }

    fn push(&mut self, row: &[Cell<'_>], kinds: &[Kind]) -> Result<()> {
        for ((column, cell), kind) in self.columns.iter_mut().zip(row).zip(kinds) {
            match (column, cell) {
                (Column::Whole(values), Cell::Whole(number)) => values.push(Some(i64::try_from(*number)?)),
                (Column::Text(values), Cell::Text(text)) => {
                    values.push(Some(ByteArray::from(text.to_string().into_bytes())))
                }
                (Column::Truth(values), Cell::Truth(truth)) => values.push(Some(*truth)),
                (Column::Bounds([lower, upper]), Cell::Bounds(bounds)) => {
                    lower.push(Some(doubles(&bounds[0])?[0]));
                    upper.push(Some(doubles(&bounds[1])?[1]));
                }
                (Column::Bounds([lower, upper]), Cell::Exact(text)) => {
                    let [low, high] = doubles(text)?;
                    lower.push(Some(low));
                    upper.push(Some(high));
                }
                (Column::Number(values), Cell::Number(number)) => values.push(Some(*number)),
                (Column::Number(values), Cell::Exact(text)) => {
                    values.push(Some(doubles(text)?[usize::from(*kind == Kind::Low)]));
                }
                (Column::Whole(values), _) => values.push(None),
                (Column::Text(values), _) => values.push(None),
                (Column::Truth(values), _) => values.push(None),
                (Column::Number(values), _) => values.push(None),
                (Column::Bounds(both), _) => both.iter_mut().for_each(|values| values.push(None)),
            }
        }
        self.rows += 1;
        Ok(())
    }

    fn write(self, mut group: SerializedRowGroupWriter<'_, &mut Output>) -> Result<()> {
        for column in self.columns {
            match column {
                Column::Whole(values) => put::<Int64Type>(&mut group, values)?,
                Column::Text(values) => put::<ByteArrayType>(&mut group, values)?,
                Column::Truth(values) => put::<BoolType>(&mut group, values)?,
                Column::Number(values) => put::<DoubleType>(&mut group, values)?,
                Column::Bounds([lower, upper]) => {
                    put::<DoubleType>(&mut group, lower)?;
                    put::<DoubleType>(&mut group, upper)?;
                }
            }
        }
        group.close()?;
        Ok(())
    }
}

/// Writes the next column of a group.
fn put<T: DataType>(group: &mut SerializedRowGroupWriter<'_, &mut Output>, values: Vec<Option<T::T>>) -> Result<()> {
    let levels: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
    let values: Vec<T::T> = values.into_iter().flatten().collect();
    let missing = || Error::from(ParquetError::General("a column is missing".into()));
    let mut column = group.next_column()?.ok_or_else(missing)?;
    column.typed::<T>().write_batch(&values, Some(&levels), None)?;
    column.close()?;
    Ok(())
}
