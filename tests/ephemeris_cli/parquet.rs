//! Reads Parquet as apache/parquet-format describes it: plain pages of numbers and text, without
//! compression. What else a file may hold is a failed test.

use std::collections::BTreeMap;

/// A value of the compact protocol of Thrift.
#[derive(Debug, Clone)]
pub enum Value {
    Int(i64),
    Text(String),
    List(Vec<Value>),
    Structure(BTreeMap<u64, Value>),
}

impl Value {
    fn field(&self, id: u64) -> &Value {
        match self {
            Value::Structure(fields) => {
                fields.get(&id).unwrap_or_else(|| panic!("no field {id} in {fields:?}"))
            }
            other => panic!("{other:?} is no structure"),
        }
    }
    fn int(&self, id: u64) -> i64 {
        match self.field(id) {
            Value::Int(value) => *value,
            other => panic!("{other:?} is no integer"),
        }
    }
    fn text(&self, id: u64) -> &str {
        match self.field(id) {
            Value::Text(text) => text,
            other => panic!("{other:?} is no text"),
        }
    }
    fn list(&self, id: u64) -> &[Value] {
        match self.field(id) {
            Value::List(items) => items,
            other => panic!("{other:?} is no list"),
        }
    }
}

/// Bytes, read from the front.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> &'a [u8] {
        let (front, rest) = self.0.split_at(count);
        self.0 = rest;
        front
    }
    fn byte(&mut self) -> u8 {
        self.take(1)[0]
    }
    fn u32(&mut self) -> usize {
        u32::from_le_bytes(self.take(4).try_into().unwrap()) as usize
    }
    fn varint(&mut self) -> u64 {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte();
            value |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                break;
            }
        }
        value
    }
    fn zigzag(&mut self) -> i64 {
        let value = self.varint();
        (value >> 1) as i64 ^ -((value & 1) as i64)
    }
    fn value(&mut self, kind: u8) -> Value {
        match kind {
            5 | 6 => Value::Int(self.zigzag()),
            8 => {
                let length = self.varint() as usize;
                Value::Text(String::from_utf8(self.take(length).to_vec()).unwrap())
            }
            9 => {
                let head = self.byte();
                let count = match head >> 4 {
                    15 => self.varint(),
                    count => count.into(),
                };
                Value::List((0..count).map(|_| self.value(head & 15)).collect())
            }
            12 => self.structure(),
            other => panic!("type {other} is not expected"),
        }
    }
    fn structure(&mut self) -> Value {
        let mut fields = BTreeMap::new();
        let mut id = 0;
        loop {
            let head = self.byte();
            if head == 0 {
                return Value::Structure(fields);
            }
            id = match head >> 4 {
                0 => self.zigzag() as u64,
                step => id + u64::from(step),
            };
            fields.insert(id, self.value(head & 15));
        }
    }
    /// Levels of one bit each: runs of equal ones and groups of eight.
    fn levels(&mut self, count: usize) -> Vec<bool> {
        let length = self.u32();
        let mut runs = Bytes(self.take(length));
        let mut levels = Vec::new();
        while levels.len() < count {
            let head = runs.varint();
            if head & 1 == 0 {
                let level = runs.byte() == 1;
                levels.extend(std::iter::repeat_n(level, (head >> 1) as usize));
            } else {
                for byte in runs.take((head >> 1) as usize) {
                    levels.extend((0..8).map(|bit| byte >> bit & 1 == 1));
                }
            }
        }
        assert!(runs.0.is_empty(), "levels are left over");
        levels.truncate(count);
        levels
    }
}

/// A column: its name and the value of every row, numbers as the shortest text that gives them back.
pub type Column = (String, Vec<Option<String>>);

/// All columns of a file.
pub fn read(file: &[u8]) -> Vec<Column> {
    assert!(file.starts_with(b"PAR1") && file.ends_with(b"PAR1"));
    let length = Bytes(&file[file.len() - 8..]).u32();
    let mut footer = Bytes(&file[file.len() - 8 - length..file.len() - 8]);
    let meta = footer.structure();
    assert!(footer.0.is_empty(), "the footer is longer than it says");
    let schema = meta.list(2);
    assert_eq!(schema[0].int(5) as usize, schema.len() - 1);
    let mut columns: Vec<Column> =
        schema[1..].iter().map(|column| (column.text(4).to_owned(), Vec::new())).collect();
    for group in meta.list(4) {
        for ((name, values), chunk) in columns.iter_mut().zip(group.list(1)) {
            let before = values.len();
            let chunk = chunk.field(3);
            assert_eq!(chunk.list(3).len(), 1);
            assert!(matches!(&chunk.list(3)[0], Value::Text(path) if path == name));
            assert_eq!((chunk.int(4), chunk.int(6)), (0, chunk.int(7)));
            let start = chunk.int(9) as usize;
            let mut bytes = Bytes(&file[start..start + chunk.int(7) as usize]);
            while !bytes.0.is_empty() {
                read_page(&mut bytes, chunk.int(1), values);
            }
            assert_eq!((values.len() - before) as i64, chunk.int(5));
            assert_eq!(chunk.int(5), group.int(3));
        }
    }
    assert!(columns.iter().all(|(_, values)| values.len() as i64 == meta.int(3)));
    columns
}

fn read_page(bytes: &mut Bytes, physical_type: i64, values: &mut Vec<Option<String>>) {
    let head = bytes.structure();
    let data = head.field(5);
    assert_eq!((head.int(1), data.int(2), data.int(3)), (0, 0, 3));
    let mut page = Bytes(bytes.take(head.int(3) as usize));
    for is_there in page.levels(data.int(1) as usize) {
        values.push(is_there.then(|| match physical_type {
            5 => f64::from_le_bytes(page.take(8).try_into().unwrap()).to_string(),
            6 => {
                let length = page.u32();
                String::from_utf8(page.take(length).to_vec()).unwrap()
            }
            other => panic!("physical type {other} is not expected"),
        }));
    }
    assert!(page.0.is_empty(), "values are left over");
}
