//! Parquet, as much of it as a table of numbers and names takes.
//!
//! *Format.* apache/parquet-format 2.10: row groups of plain pages without compression, every column
//! optional, and a footer in the compact protocol of Thrift. Nothing else of the format is used, so
//! that a crate of a minute's building is not needed for it. `tests/truth/read_parquet.py` has pyarrow
//! read a table and compares it with the same table in CSV.
//!
//! ```text
//! "PAR1"  { column chunk: { page header, definition levels, values }* }*  footer  length  "PAR1"
//! ```

use std::io::{self, Write};

use super::{Cell, Column};

const MAGIC: &[u8; 4] = b"PAR1";
const CREATED_BY: &str = concat!("nocturne version ", env!("CARGO_PKG_VERSION"));

// Numbers of parquet.thrift.
const TYPE_DOUBLE: i64 = 5;
const TYPE_BYTE_ARRAY: i64 = 6;
const OPTIONAL: i64 = 1;
const CONVERTED_UTF8: i64 = 0;
const ENCODING_PLAIN: i64 = 0;
const ENCODING_RLE: i64 = 3;
const CODEC_UNCOMPRESSED: i64 = 0;
const PAGE_DATA: i64 = 0;

/// Rows by column: which of them have a value, and the values one after the other.
#[derive(Debug, Clone)]
pub struct Rows {
    count: usize,
    columns: Vec<Values>,
}

#[derive(Debug, Clone, Default)]
struct Values {
    is_text: bool,
    /// A bit for each row, the first the lowest of its byte.
    present: Vec<u8>,
    present_count: usize,
    plain: Vec<u8>,
}

impl Rows {
    pub fn new(columns: &[Column]) -> Rows {
        let values = |column: &Column| Values { is_text: column.is_text(), ..Values::default() };
        Rows { count: 0, columns: columns.iter().map(values).collect() }
    }

    pub fn add(&mut self, cells: &[Cell]) {
        for (values, cell) in self.columns.iter_mut().zip(cells) {
            if self.count.is_multiple_of(8) {
                values.present.push(0);
            }
            match (*cell, values.is_text) {
                (Cell::Text(text), true) => {
                    values.plain.extend((text.len() as u32).to_le_bytes());
                    values.plain.extend_from_slice(text.as_bytes());
                }
                (Cell::Number(value) | Cell::Written(_, value), false) => {
                    values.plain.extend(value.to_le_bytes());
                }
                _ => continue,
            }
            values.present[self.count / 8] |= 1 << (self.count % 8);
            values.present_count += 1;
        }
        self.count += 1;
    }
}

impl Values {
    /// A data page: its header, whether each row has a value, the values.
    fn page(&self, count: usize) -> Vec<u8> {
        let mut levels = Vec::new();
        if self.present_count == 0 || self.present_count == count {
            // One run of equal levels.
            varint(&mut levels, (count as u64) << 1);
            levels.push(u8::from(self.present_count > 0));
        } else {
            // Groups of eight, a bit each.
            varint(&mut levels, (self.present.len() as u64) << 1 | 1);
            levels.extend_from_slice(&self.present);
        }
        let size = (4 + levels.len() + self.plain.len()) as i64;
        let mut page = Thrift::default();
        page.int(1, PAGE_DATA);
        page.int(2, size);
        page.int(3, size);
        page.structure(5, |page| {
            page.int(1, count as i64);
            page.int(2, ENCODING_PLAIN);
            page.int(3, ENCODING_RLE);
            page.int(4, ENCODING_RLE);
        });
        let mut bytes = page.end();
        bytes.extend((levels.len() as u32).to_le_bytes());
        bytes.extend(levels);
        bytes.extend_from_slice(&self.plain);
        bytes
    }
}

/// Where a column of a row group stands in the file.
struct Chunk {
    offset: u64,
    length: u64,
}

struct Group {
    rows: usize,
    chunks: Vec<Chunk>,
}

/// Writes row groups and knows where they are.
pub struct Writer<'a> {
    columns: &'a [Column],
    groups: Vec<Group>,
    offset: u64,
}

impl<'a> Writer<'a> {
    pub fn begin(columns: &'a [Column], out: &mut impl Write) -> io::Result<Writer<'a>> {
        out.write_all(MAGIC)?;
        Ok(Writer { columns, groups: Vec::new(), offset: MAGIC.len() as u64 })
    }

    /// Writes a row group, in each of its columns a page for each of the parts.
    pub fn put(&mut self, out: &mut impl Write, parts: &[&Rows]) -> io::Result<()> {
        let rows = parts.iter().map(|part| part.count).sum();
        if rows == 0 {
            return Ok(());
        }
        let mut chunks = Vec::with_capacity(self.columns.len());
        for index in 0..self.columns.len() {
            let offset = self.offset;
            for part in parts.iter().filter(|part| part.count > 0) {
                let page = part.columns[index].page(part.count);
                out.write_all(&page)?;
                self.offset += page.len() as u64;
            }
            chunks.push(Chunk { offset, length: self.offset - offset });
        }
        self.groups.push(Group { rows, chunks });
        Ok(())
    }

    /// Writes the footer.
    pub fn end(self, out: &mut impl Write) -> io::Result<()> {
        let footer = self.footer();
        out.write_all(&footer)?;
        out.write_all(&(footer.len() as u32).to_le_bytes())?;
        out.write_all(MAGIC)
    }

    fn footer(&self) -> Vec<u8> {
        let mut footer = Thrift::default();
        footer.int(1, 1); // version
        footer.list(2, STRUCT, self.columns.len() + 1);
        footer.element(|root| {
            root.text(4, "schema");
            root.int(5, self.columns.len() as i64);
        });
        for column in self.columns {
            footer.element(|element| {
                element.int(1, physical_type(column));
                element.int(3, OPTIONAL);
                element.text(4, column.name);
                if column.is_text() {
                    element.int(6, CONVERTED_UTF8);
                    // The logical type STRING, an empty structure in a union.
                    element.structure(10, |logical| logical.structure(1, |_| ()));
                }
            });
        }
        footer.long(3, self.groups.iter().map(|group| group.rows as i64).sum());
        footer.list(4, STRUCT, self.groups.len());
        for group in &self.groups {
            footer.element(|element| self.group(element, group));
        }
        footer.text(6, CREATED_BY);
        footer.end()
    }

    fn group(&self, element: &mut Thrift, group: &Group) {
        element.list(1, STRUCT, group.chunks.len());
        for (column, chunk) in self.columns.iter().zip(&group.chunks) {
            element.element(|element| {
                element.long(2, chunk.offset as i64);
                element.structure(3, |meta| {
                    meta.int(1, physical_type(column));
                    meta.list(2, I32, 2);
                    meta.item(ENCODING_PLAIN);
                    meta.item(ENCODING_RLE);
                    meta.list(3, BINARY, 1);
                    meta.bytes(column.name);
                    meta.int(4, CODEC_UNCOMPRESSED);
                    meta.long(5, group.rows as i64);
                    meta.long(6, chunk.length as i64);
                    meta.long(7, chunk.length as i64);
                    meta.long(9, chunk.offset as i64);
                });
            });
        }
        element.long(2, group.chunks.iter().map(|chunk| chunk.length as i64).sum());
        element.long(3, group.rows as i64);
    }
}

fn physical_type(column: &Column) -> i64 {
    if column.is_text() { TYPE_BYTE_ARRAY } else { TYPE_DOUBLE }
}

// Types of the compact protocol.
const I32: u8 = 5;
const I64: u8 = 6;
const BINARY: u8 = 8;
const LIST: u8 = 9;
const STRUCT: u8 = 12;

/// A structure in the compact protocol of Thrift.
#[derive(Default)]
struct Thrift {
    bytes: Vec<u8>,
    /// Fields are numbered by their distance from the last.
    last_field: u8,
}

impl Thrift {
    fn field(&mut self, id: u8, kind: u8) {
        self.bytes.push((id - self.last_field) << 4 | kind);
        self.last_field = id;
    }
    fn int(&mut self, id: u8, value: i64) {
        self.field(id, I32);
        self.item(value);
    }
    fn long(&mut self, id: u8, value: i64) {
        self.field(id, I64);
        self.item(value);
    }
    fn text(&mut self, id: u8, text: &str) {
        self.field(id, BINARY);
        self.bytes(text);
    }
    fn structure(&mut self, id: u8, fill: impl FnOnce(&mut Thrift)) {
        self.field(id, STRUCT);
        self.element(fill);
    }
    /// The head of a list; its items follow.
    fn list(&mut self, id: u8, kind: u8, count: usize) {
        self.field(id, LIST);
        if count < 15 {
            self.bytes.push((count as u8) << 4 | kind);
        } else {
            self.bytes.push(0xf0 | kind);
            varint(&mut self.bytes, count as u64);
        }
    }
    fn item(&mut self, value: i64) {
        // Zigzag: the sign is the lowest bit.
        varint(&mut self.bytes, (value << 1 ^ value >> 63) as u64);
    }
    fn bytes(&mut self, text: &str) {
        varint(&mut self.bytes, text.len() as u64);
        self.bytes.extend_from_slice(text.as_bytes());
    }
    /// A structure in a list.
    fn element(&mut self, fill: impl FnOnce(&mut Thrift)) {
        let outer = std::mem::take(&mut self.last_field);
        fill(self);
        self.bytes.push(0);
        self.last_field = outer;
    }
    fn end(mut self) -> Vec<u8> {
        self.bytes.push(0);
        self.bytes
    }
}

/// Seven bits a byte, lowest first.
fn varint(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}
