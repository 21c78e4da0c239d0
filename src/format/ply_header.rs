//! The header of a PLY file: elements, their numbers, and the types of their properties.

use super::error::{FormatError, Reason};
use super::text::Text;

/// How the numbers after the header are written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Type {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Type {
    pub fn size(self) -> u64 {
        match self {
            Type::I8 | Type::U8 => 1,
            Type::I16 | Type::U16 => 2,
            Type::I32 | Type::U32 | Type::F32 => 4,
            Type::I64 | Type::U64 | Type::F64 => 8,
        }
    }

    fn is_whole(self) -> bool {
        !matches!(self, Type::F32 | Type::F64)
    }

    fn of(token: &[u8]) -> Option<Type> {
        Some(match &token.to_ascii_lowercase()[..] {
            b"char" | b"int8" => Type::I8,
            b"uchar" | b"uint8" => Type::U8,
            b"short" | b"int16" => Type::I16,
            b"ushort" | b"uint16" => Type::U16,
            b"int" | b"int32" => Type::I32,
            b"uint" | b"uint32" => Type::U32,
            b"int64" | b"long" => Type::I64,
            b"uint64" | b"ulong" => Type::U64,
            b"float" | b"float32" => Type::F32,
            b"double" | b"float64" => Type::F64,
            _ => return None,
        })
    }
}

/// What a property is to us.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Property {
    /// Coordinate 0, 1 or 2 of a vertex.
    Coordinate(usize, Type),
    /// End 0 or 1 of an edge.
    End(usize, Type),
    /// The corners of a face or strip: the types of their number and of each.
    Corners(Type, Type),
    /// What part of a model a face belongs to: its marker.
    Label(Type),
    /// Red, green, blue or alpha of a face.
    Colour(usize, Type),
    /// A number of no use to us.
    Other(Type),
    /// A list of no use to us.
    OtherList(Type, Type),
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Vertex,
    Face,
    /// Strips of triangles.
    Strips,
    Edge,
    Other,
}

pub(super) struct Element {
    pub role: Role,
    pub count: u64,
    pub properties: Vec<Property>,
}

impl Element {
    /// The fewest bytes that one takes in a binary file.
    pub fn least_size(&self) -> u64 {
        let size = |property: &Property| match *property {
            Property::Corners(counter, corner) => counter.size() + 3 * corner.size(),
            Property::OtherList(counter, _) => counter.size(),
            Property::Coordinate(_, kind)
            | Property::End(_, kind)
            | Property::Colour(_, kind)
            | Property::Label(kind)
            | Property::Other(kind) => kind.size(),
        };
        self.properties.iter().map(size).sum()
    }

    /// Whether it has a property.
    pub fn has(&self, is: fn(&Property) -> bool) -> bool {
        self.properties.iter().any(is)
    }
}

pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    pub vertices: u64,
}

/// Reads up to `end_header`. Each statement may end with a comment in braces, and another may follow on the same line.
pub(super) fn header(text: &mut Text) -> Result<Header, FormatError> {
    text.begin("the header ply")?;
    match text.token() {
        Some(word) if word.eq_ignore_ascii_case(b"ply") => end_statement(text)?,
        token => return Err(text.bad(token.unwrap_or_default(), "ply")),
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut vertices = None;
    loop {
        if !text.has_word() {
            text.begin("end_header")?;
        }
        let token = text.here("a word")?;
        match &token.to_ascii_lowercase()[..] {
            b"comment" | b"obj_info" => text.skip_line(),
            b"format" if encoding.is_some() => return Err(text.error(Reason::Twice("format is"))),
            b"format" => encoding = Some(format(text)?),
            b"element" => {
                let element = element(text)?;
                check_last(text, &elements)?;
                if element.role == Role::Vertex && vertices.replace(element.count).is_some() {
                    return Err(text.error(Reason::Twice("element vertex is")));
                }
                elements.push(element);
            }
            b"property" => {
                let missing = text.error(Reason::Missing("the element of this property is"));
                let element = elements.last_mut().ok_or(missing)?;
                let property = property(text, element.role)?;
                if is_twice(&element.properties, property) {
                    return Err(text.error(Reason::Twice("this property is")));
                }
                element.properties.push(property);
            }
            b"end_header" => {
                // The numbers may begin on the same line, if they are words.
                if encoding != Some(Encoding::Ascii) {
                    text.end_line()?;
                }
                break;
            }
            _ => {
                let expected = "format, element, property, comment, obj_info or end_header";
                return Err(text.bad(token, expected));
            }
        }
    }
    check_last(text, &elements)?;
    Ok(Header {
        encoding: encoding.ok_or_else(|| text.error(Reason::Missing("the line format is")))?,
        vertices: vertices.ok_or_else(|| text.error(Reason::Missing("element vertex is")))?,
        elements,
    })
}

/// The line ends, or another statement begins.
fn end_statement(text: &mut Text) -> Result<(), FormatError> {
    const WORDS: [&str; 6] = [
        "format",
        "comment",
        "obj_info",
        "element",
        "property",
        "end_header",
    ];
    let mark = text.mark();
    let token = text.token().unwrap_or_default();
    let follows = WORDS
        .iter()
        .any(|word| token.eq_ignore_ascii_case(word.as_bytes()));
    text.return_to(mark);
    if follows { Ok(()) } else { text.end_line() }
}

fn format(text: &mut Text) -> Result<Encoding, FormatError> {
    let token = text.here("the encoding")?;
    let encoding = match &token.to_ascii_lowercase()[..] {
        b"ascii" => Encoding::Ascii,
        b"binary_little_endian" => Encoding::LittleEndian,
        b"binary_big_endian" => Encoding::BigEndian,
        _ => {
            return Err(text.bad(token, "ascii, binary_little_endian or binary_big_endian"));
        }
    };
    match text.here("the version 1.0")? {
        b"1.0" => end_statement(text)?,
        token => return Err(text.bad(token, "the version 1.0")),
    }
    Ok(encoding)
}

fn element(text: &mut Text) -> Result<Element, FormatError> {
    let name = text.here("the name of an element")?;
    let token = text.here("the number of elements")?;
    let (role, count) = match &name.to_ascii_lowercase()[..] {
        b"vertex" => (Role::Vertex, text.vertex_count(token)?),
        b"face" => (Role::Face, text.count(token, "the number of faces")?),
        b"edge" => (Role::Edge, text.count(token, "the number of edges")?),
        b"tristrips" => (Role::Strips, text.count(token, "the number of strips")?),
        _ => (Role::Other, text.count(token, "the number of elements")?),
    };
    end_statement(text)?;
    if role == Role::Vertex && count == 0 {
        return Err(text.error(Reason::NoVertices));
    }
    Ok(Element {
        role,
        count,
        properties: Vec::new(),
    })
}

/// Whole numbers of faces that say which part of a model they belong to.
const LABELS: [&[u8]; 16] = [
    b"label",
    b"labels",
    b"marker",
    b"markers",
    b"region",
    b"region_id",
    b"material",
    b"material_id",
    b"material_index",
    b"group",
    b"group_id",
    b"object",
    b"object_id",
    b"segment_id",
    b"category_id",
    b"part_id",
];

/// The components of a colour.
const COLOURS: [&[u8]; 4] = [b"red", b"green", b"blue", b"alpha"];

fn property(text: &mut Text, role: Role) -> Result<Property, FormatError> {
    let mut token = text.here("the type of a property")?;
    let list = token.eq_ignore_ascii_case(b"list");
    let mut counter = None;
    if list {
        token = text.here("the type of the length of a list")?;
        counter = Some(whole_type(text, token)?);
        token = text.here("the type of the members of a list")?;
    }
    let kind = some_type(text, token)?;
    let name = text.here("the name of a property")?.to_ascii_lowercase();
    end_statement(text)?;
    let colour = COLOURS.iter().position(|colour| *colour == name);
    let is_label = kind.is_whole() && LABELS.contains(&&name[..]);
    Ok(match (role, &name[..], counter) {
        (Role::Face | Role::Strips, b"vertex_indices" | b"vertex_index", Some(counter)) => {
            Property::Corners(counter, whole_type(text, token)?)
        }
        (_, _, Some(counter)) => Property::OtherList(counter, kind),
        (Role::Vertex, b"x", _) => Property::Coordinate(0, kind),
        (Role::Vertex, b"y", _) => Property::Coordinate(1, kind),
        (Role::Vertex, b"z", _) => Property::Coordinate(2, kind),
        (Role::Edge, b"vertex1", _) => Property::End(0, whole_type(text, token)?),
        (Role::Edge, b"vertex2", _) => Property::End(1, whole_type(text, token)?),
        (Role::Face, ..) if is_label => Property::Label(kind),
        (Role::Face, ..) if kind.is_whole() && kind.size() <= 2 => match colour {
            Some(component) => Property::Colour(component, kind),
            None => Property::Other(kind),
        },
        _ => Property::Other(kind),
    })
}

fn some_type(text: &Text, token: &[u8]) -> Result<Type, FormatError> {
    let expected = "a type: char, uchar, short, ushort, int, uint, float, double or list";
    Type::of(token).ok_or_else(|| text.bad(token, expected))
}

fn whole_type(text: &Text, token: &[u8]) -> Result<Type, FormatError> {
    let kind = Type::of(token).filter(|t| t.is_whole());
    kind.ok_or_else(|| text.bad(token, "a type of whole numbers"))
}

/// Whether there is a property with the meaning of the given one.
fn is_twice(properties: &[Property], given: Property) -> bool {
    properties.iter().any(|&p| match (p, given) {
        (Property::Coordinate(i, _), Property::Coordinate(j, _)) => i == j,
        (Property::End(i, _), Property::End(j, _)) => i == j,
        (Property::Corners(..), Property::Corners(..)) => true,
        _ => false,
    })
}

/// Whether the last element, all of whose properties are known now, has those that it needs.
fn check_last(text: &Text, elements: &[Element]) -> Result<(), FormatError> {
    let Some(last) = elements.last() else {
        return Ok(());
    };
    let has = |test: fn(&Property) -> bool| last.properties.iter().filter(|p| test(p)).count();
    let missing = match last.role {
        Role::Vertex if has(|p| matches!(p, Property::Coordinate(..))) != 3 => {
            "one of the properties x, y and z of vertices is"
        }
        Role::Face | Role::Strips
            if last.count > 0 && has(|p| matches!(p, Property::Corners(..))) != 1 =>
        {
            "the list vertex_indices of faces is"
        }
        Role::Edge if last.count > 0 && has(|p| matches!(p, Property::End(..))) != 2 => {
            "one of the properties vertex1 and vertex2 of edges is"
        }
        _ => return Ok(()),
    };
    Err(text.error(Reason::Missing(missing)))
}
