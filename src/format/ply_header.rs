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
    F32,
    F64,
}

impl Type {
    pub fn size(self) -> u64 {
        match self {
            Type::I8 | Type::U8 => 1,
            Type::I16 | Type::U16 => 2,
            Type::I32 | Type::U32 | Type::F32 => 4,
            Type::F64 => 8,
        }
    }

    fn is_whole(self) -> bool {
        !matches!(self, Type::F32 | Type::F64)
    }

    fn of(token: &[u8]) -> Option<Type> {
        Some(match token {
            b"char" | b"int8" => Type::I8,
            b"uchar" | b"uint8" => Type::U8,
            b"short" | b"int16" => Type::I16,
            b"ushort" | b"uint16" => Type::U16,
            b"int" | b"int32" => Type::I32,
            b"uint" | b"uint32" => Type::U32,
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
    /// The corners of a face: the types of their number and of each.
    Corners(Type, Type),
    /// A number of no use to us.
    Other(Type),
    /// A list of no use to us.
    OtherList(Type, Type),
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Vertex,
    Face,
    Edge,
    Other,
}

pub(super) struct Element {
    pub role: Role,
    pub count: u64,
    pub properties: Vec<Property>,
}

pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    pub vertices: u64,
}

/// Reads up to `end_header`.
pub(super) fn header(text: &mut Text) -> Result<Header, FormatError> {
    text.begin("the header ply")?;
    match text.token() {
        Some(b"ply") => text.end_line()?,
        token => return Err(text.bad(token.unwrap_or_default(), "ply")),
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut vertices = None;
    loop {
        text.begin("end_header")?;
        match text.here("a word")? {
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
                text.end_line()?;
                break;
            }
            token => {
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

fn format(text: &mut Text) -> Result<Encoding, FormatError> {
    let encoding = match text.here("the encoding")? {
        b"ascii" => Encoding::Ascii,
        b"binary_little_endian" => Encoding::LittleEndian,
        b"binary_big_endian" => Encoding::BigEndian,
        token => {
            return Err(text.bad(token, "ascii, binary_little_endian or binary_big_endian"));
        }
    };
    match text.here("the version 1.0")? {
        b"1.0" => text.end_line()?,
        token => return Err(text.bad(token, "the version 1.0")),
    }
    Ok(encoding)
}

fn element(text: &mut Text) -> Result<Element, FormatError> {
    let name = text.here("the name of an element")?;
    let token = text.here("the number of elements")?;
    let (role, count) = match name {
        b"vertex" => (Role::Vertex, text.vertex_count(token)?),
        b"face" => (Role::Face, text.count(token, "the number of faces")?),
        b"edge" => (Role::Edge, text.count(token, "the number of edges")?),
        _ => (Role::Other, text.count(token, "the number of elements")?),
    };
    text.end_line()?;
    if role == Role::Vertex && count == 0 {
        return Err(text.error(Reason::NoVertices));
    }
    // To skip it would lose faces.
    if name == b"tristrips" && count > 0 {
        return Err(text.error(Reason::Unsupported("triangle strips are")));
    }
    Ok(Element {
        role,
        count,
        properties: Vec::new(),
    })
}

fn property(text: &mut Text, role: Role) -> Result<Property, FormatError> {
    let mut token = text.here("the type of a property")?;
    let list = token == b"list";
    let mut counter = None;
    if list {
        token = text.here("the type of the length of a list")?;
        counter = Some(whole_type(text, token)?);
        token = text.here("the type of the members of a list")?;
    }
    let kind = some_type(text, token)?;
    let name = text.here("the name of a property")?;
    text.end_line()?;
    Ok(match (role, name, counter) {
        (Role::Face, b"vertex_indices" | b"vertex_index", Some(counter)) => {
            Property::Corners(counter, whole_type(text, token)?)
        }
        (_, _, Some(counter)) => Property::OtherList(counter, kind),
        (Role::Vertex, b"x", _) => Property::Coordinate(0, kind),
        (Role::Vertex, b"y", _) => Property::Coordinate(1, kind),
        (Role::Vertex, b"z", _) => Property::Coordinate(2, kind),
        (Role::Edge, b"vertex1", _) => Property::End(0, whole_type(text, token)?),
        (Role::Edge, b"vertex2", _) => Property::End(1, whole_type(text, token)?),
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
        Role::Face if last.count > 0 && has(|p| matches!(p, Property::Corners(..))) != 1 => {
            "the list vertex_indices of faces is"
        }
        Role::Edge if last.count > 0 && has(|p| matches!(p, Property::End(..))) != 2 => {
            "one of the properties vertex1 and vertex2 of edges is"
        }
        _ => return Ok(()),
    };
    Err(text.error(Reason::Missing(missing)))
}
