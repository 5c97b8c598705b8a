//! Parquet tables of impacts and of bodies: a column per number, with the names that the .csv has.
//!
//! Columns are not compressed: a coordinate has no two digits alike. Those that repeat themselves (names, restitution, a spin
//! that is nought) are dictionaries.
use crate::cast::{Cast, Frame};
use carom::{Impact, Party, Rotates, State, Vector};
use parquet::basic::{ConvertedType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};
use std::io::{self, Write};
use std::sync::Arc;

/// Rows that are kept until they are written: a piece that can be read by itself.
const ROWS: usize = 1 << 16;

enum Column {
    Numbers(Vec<f64>),
    Wholes(Vec<i64>),
    Texts(Vec<ByteArray>),
}

/// What a column holds.
#[derive(Clone, Copy, PartialEq)]
enum Holds {
    Number,
    /// A number that is the same most of the time.
    Steady,
    Whole,
    Text,
}

/// A table under way.
struct Table<W: Write + Send> {
    file: SerializedFileWriter<W>,
    columns: Vec<Column>,
    rows: usize,
    /// The column of the row under way.
    at: usize,
}

impl<W: Write + Send> Table<W> {
    fn new(to: W, columns: &[(String, Holds)]) -> io::Result<Self> {
        let mut properties = WriterProperties::builder()
            .set_created_by(concat!("carom ", env!("CARGO_PKG_VERSION")).into())
            .set_statistics_enabled(EnabledStatistics::None)
            .set_dictionary_enabled(false);
        let mut fields = Vec::new();
        for (name, holds) in columns {
            let physical = match holds {
                Holds::Number | Holds::Steady => Physical::DOUBLE,
                Holds::Whole => Physical::INT64,
                Holds::Text => Physical::BYTE_ARRAY,
            };
            let text = if *holds == Holds::Text { ConvertedType::UTF8 } else { ConvertedType::NONE };
            let field = Type::primitive_type_builder(name, physical)
                .with_repetition(Repetition::REQUIRED)
                .with_converted_type(text)
                .build()
                .map_err(told)?;
            fields.push(Arc::new(field));
            if matches!(holds, Holds::Steady | Holds::Text) {
                properties = properties.set_column_dictionary_enabled(ColumnPath::from(name.as_str()), true);
            }
        }
        let schema = Type::group_type_builder("carom").with_fields(fields).build().map_err(told)?;
        let file = SerializedFileWriter::new(to, Arc::new(schema), Arc::new(properties.build())).map_err(told)?;
        let empty = |holds: &Holds| match holds {
            Holds::Number | Holds::Steady => Column::Numbers(Vec::with_capacity(ROWS)),
            Holds::Whole => Column::Wholes(Vec::with_capacity(ROWS)),
            Holds::Text => Column::Texts(Vec::with_capacity(ROWS)),
        };
        Ok(Self { file, columns: columns.iter().map(|(_, holds)| empty(holds)).collect(), rows: 0, at: 0 })
    }

    #[inline]
    fn number(&mut self, x: f64) {
        if let Some(Column::Numbers(column)) = self.columns.get_mut(self.at) {
            column.push(x);
        }
        self.at += 1;
    }

    fn numbers(&mut self, all: &[f64]) {
        all.iter().for_each(|&x| self.number(x));
    }

    fn whole(&mut self, x: i64) {
        if let Some(Column::Wholes(column)) = self.columns.get_mut(self.at) {
            column.push(x);
        }
        self.at += 1;
    }

    fn text(&mut self, x: &ByteArray) {
        if let Some(Column::Texts(column)) = self.columns.get_mut(self.at) {
            column.push(x.clone());
        }
        self.at += 1;
    }

    fn end_row(&mut self) -> io::Result<()> {
        debug_assert_eq!(self.at, self.columns.len(), "every column of the row");
        self.at = 0;
        self.rows += 1;
        if self.rows == ROWS { self.write() } else { Ok(()) }
    }

    /// Writes the rows that are kept.
    fn write(&mut self) -> io::Result<()> {
        if self.rows == 0 {
            return Ok(());
        }
        self.rows = 0;
        let mut group = self.file.next_row_group().map_err(told)?;
        for column in &mut self.columns {
            let Some(mut writer) = group.next_column().map_err(told)? else { break };
            match column {
                Column::Numbers(values) => {
                    writer.typed::<DoubleType>().write_batch(values, None, None).map_err(told)?;
                    values.clear();
                }
                Column::Wholes(values) => {
                    writer.typed::<Int64Type>().write_batch(values, None, None).map_err(told)?;
                    values.clear();
                }
                Column::Texts(values) => {
                    writer.typed::<ByteArrayType>().write_batch(values, None, None).map_err(told)?;
                    values.clear();
                }
            }
            writer.close().map_err(told)?;
        }
        group.close().map_err(told)?;
        Ok(())
    }

    fn finish(mut self) -> io::Result<W> {
        self.write()?;
        self.file.into_inner().map_err(told)
    }
}

/// What went wrong, as the system says it where it was the system.
fn told(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(inner) => match inner.downcast::<io::Error>() {
            Ok(system) => *system,
            Err(inner) => io::Error::other(inner),
        },
        other => io::Error::other(other),
    }
}

const AXES: [char; 3] = ['x', 'y', 'z'];

/// `name_x`, `name_y`, ...
fn components(columns: &mut Vec<(String, Holds)>, name: &str, dim: usize, holds: Holds) {
    columns.extend(AXES.iter().take(dim).map(|axis| (format!("{name}_{axis}"), holds)));
}

/// Nothing on a line, `name` in the plane, three components in space.
fn spins(columns: &mut Vec<(String, Holds)>, name: &str, dim: usize) {
    match dim {
        1 => {}
        2 => columns.push((name.into(), Holds::Steady)),
        _ => components(columns, name, 3, Holds::Steady),
    }
}

/// A table with a row for each impact: n, time, first, second, point, normal, approach, departure, restitution, impulse,
/// friction_impulse, how both moved before and after, lost, together.
pub struct Impacts<W: Write + Send> {
    table: Table<W>,
    bodies: Vec<ByteArray>,
    walls: Vec<ByteArray>,
}

impl<W: Write + Send> Impacts<W> {
    /// Starts a table of a world of this dimension, with these names of bodies and walls, in the order of their places.
    pub fn new(to: W, dim: usize, bodies: &[String], walls: &[String]) -> io::Result<Self> {
        let mut columns: Vec<(String, Holds)> = Vec::new();
        let texts = ["first", "second"];
        columns.extend([("n".into(), Holds::Whole), ("time".into(), Holds::Number)]);
        columns.extend(texts.map(|name| (name.into(), Holds::Text)));
        components(&mut columns, "point", dim, Holds::Number);
        components(&mut columns, "normal", dim, Holds::Number);
        columns.extend(["approach", "departure"].map(|name| (name.into(), Holds::Number)));
        columns.push(("restitution".into(), Holds::Steady));
        columns.push(("impulse".into(), Holds::Number));
        components(&mut columns, "friction_impulse", dim, Holds::Steady);
        for when in ["before", "after"] {
            for who in texts {
                components(&mut columns, &format!("{who}_{when}_velocity"), dim, Holds::Number);
                spins(&mut columns, &format!("{who}_{when}_spin"), dim);
            }
        }
        columns.extend([("lost".into(), Holds::Number), ("together".into(), Holds::Whole)]);
        let names = |all: &[String]| all.iter().map(|name| ByteArray::from(name.as_str())).collect();
        Ok(Self { table: Table::new(to, &columns)?, bodies: names(bodies), walls: names(walls) })
    }

    /// Adds impacts; the number of the first of them, from 1.
    pub fn add<const D: usize>(&mut self, first: u64, impacts: &[Impact<D>]) -> io::Result<()>
    where
        Vector<D>: Rotates,
    {
        let nobody = ByteArray::from("");
        for (n, impact) in (first..).zip(impacts) {
            let table = &mut self.table;
            table.whole(n as i64);
            table.number(impact.time);
            for party in impact.parties {
                table.text(match party {
                    Party::Body(id) => self.bodies.get(id.index()).unwrap_or(&nobody),
                    Party::Wall(id) => self.walls.get(id.index()).unwrap_or(&nobody),
                });
            }
            table.numbers(&impact.point.0);
            table.numbers(&impact.normal.0);
            table.numbers(&[impact.approach, impact.departure, impact.restitution, impact.impulse]);
            table.numbers(&impact.friction_impulse.0);
            for State { velocity, spin } in impact.before.iter().chain(&impact.after) {
                table.numbers(&velocity.0);
                table.numbers(Vector::<D>::spin_slice(spin));
            }
            table.number(impact.lost);
            table.whole(i64::from(impact.together));
            table.end_row()?;
        }
        Ok(())
    }

    /// Completes the file. What it was written to comes back.
    pub fn finish(self) -> io::Result<W> {
        self.table.finish()
    }
}

/// A table with a row for each body of each frame: time, name, position, velocity, spin.
pub struct Bodies<W: Write + Send> {
    table: Table<W>,
    names: Vec<ByteArray>,
    dim: usize,
}

impl<W: Write + Send> Bodies<W> {
    /// Starts a table.
    pub fn new(to: W, cast: &Cast) -> io::Result<Self> {
        let mut columns = vec![("time".into(), Holds::Steady), ("name".into(), Holds::Text)];
        components(&mut columns, "position", cast.dim, Holds::Number);
        components(&mut columns, "velocity", cast.dim, Holds::Number);
        spins(&mut columns, "spin", cast.dim);
        let names = cast.bodies.iter().map(|b| ByteArray::from(b.name.as_str())).collect();
        Ok(Self { table: Table::new(to, &columns)?, names, dim: cast.dim })
    }

    /// Adds a frame.
    pub fn frame(&mut self, frame: &Frame<'_>) -> io::Result<()> {
        for (name, at) in self.names.iter().zip(frame.bodies) {
            self.table.number(frame.time);
            self.table.text(name);
            self.table.numbers(&at.position[..self.dim]);
            self.table.numbers(&at.velocity[..self.dim]);
            match self.dim {
                1 => {}
                2 => self.table.number(at.spin[2]),
                _ => self.table.numbers(&at.spin),
            }
            self.table.end_row()?;
        }
        Ok(())
    }

    /// Completes the file. What it was written to comes back.
    pub fn finish(self) -> io::Result<W> {
        self.table.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cast::tests::two;
    use ::parquet::file::reader::{FileReader, SerializedFileReader};
    use ::parquet::record::Field;
    use carom::{Ball, World};

    /// All rows, as (name, value).
    fn rows(bytes: Vec<u8>) -> Vec<Vec<(String, Field)>> {
        let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).unwrap();
        let rows = reader.get_row_iter(None).unwrap();
        rows.map(|row| row.unwrap().into_columns()).collect()
    }

    #[test]
    fn impacts_come_back_to_the_last_bit() {
        let mut world = World::<2>::new();
        world.ball(Ball::new(2.0, 0.1).at([-1.0, 0.05]).moving([3.0, 0.0]).spinning([0.3]));
        world.ball(Ball::new(1.0, 0.1).at([1.0, 0.0]).moving([-1.0, 0.1]));
        let impact = world.advance(1.0)[0];
        let names = ["A".to_string(), "B, the \"second\"".to_string()];
        let mut table = Impacts::new(Vec::new(), 2, &names, &[]).unwrap();
        // More than one piece.
        let many = vec![impact; ROWS + 5];
        table.add(1, &many).unwrap();
        let rows = rows(table.finish().unwrap());
        assert_eq!(rows.len(), ROWS + 5);
        for n in [0, ROWS - 1, ROWS + 4] {
            let cell = |name: &str| rows[n].iter().find(|(head, _)| head == name).expect(name).1.clone();
            assert_eq!(cell("n"), Field::Long(n as i64 + 1));
            assert_eq!(cell("second"), Field::Str(names[1].clone()));
            assert_eq!(cell("together"), Field::Long(1));
            for (name, x) in [
                ("time", impact.time),
                ("point_y", impact.point[1]),
                ("impulse", impact.impulse),
                ("first_before_spin", 0.3),
                ("second_after_velocity_x", impact.after[1].velocity[0]),
                ("lost", impact.lost),
            ] {
                assert_eq!(cell(name), Field::Double(x), "{name}");
            }
        }
    }

    #[test]
    fn bodies_come_back_to_the_last_bit() {
        let (cast, moments) = two();
        let mut table = Bodies::new(Vec::new(), &cast).unwrap();
        for number in 0..3 {
            table.frame(&Frame { number, time: 0.1 * number as f64, bodies: &moments }).unwrap();
        }
        let rows = rows(table.finish().unwrap());
        assert_eq!(rows.len(), 6);
        let names: Vec<&str> = rows[0].iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["time", "name", "position_x", "position_y", "velocity_x", "velocity_y", "spin"]);
        let field = |x: f64| Field::Double(x);
        let want = [field(0.2), Field::Str("A".into()), field(1.0 / 3.0), field(1e-17), field(-0.1), field(1e300)];
        assert_eq!(rows[4].iter().map(|c| c.1.clone()).take(6).collect::<Vec<_>>(), want);
        assert_eq!(rows[4][6].1, field(1.0 / 3.0));
    }
}
