//! Places in a JSON text: each value knows its path, so that what is wrong with it can be told.

use crate::asset::model::MeshError;
use serde_json::Value;

/// The largest whole number that every program stores exactly (RFC 8259, section 6).
const MOST: u64 = 1 << 53;

/// A value and where it is.
#[derive(Clone, Debug)]
pub(super) struct At<'a> {
    pub(super) value: &'a Value,
    pub(super) path: String,
}

impl<'a> At<'a> {
    /// The whole of a text.
    pub(super) fn root(value: &'a Value) -> Self {
        Self { value, path: String::new() }
    }

    /// A mistake here.
    pub(super) fn wrong(&self, reason: impl Into<String>) -> MeshError {
        MeshError::At { path: self.path.clone(), reason: reason.into() }
    }

    /// A field of an object, unless it is missing.
    pub(super) fn get(&self, name: &str) -> Option<Self> {
        let value = self.value.get(name).filter(|value| !value.is_null())?;
        let dot = if self.path.is_empty() { "" } else { "." };
        Some(Self { value, path: format!("{}{dot}{name}", self.path) })
    }

    /// A field that has to be there.
    pub(super) fn need(&self, name: &str) -> Result<Self, MeshError> {
        self.get(name).ok_or_else(|| match self.path.as_str() {
            "" => MeshError::whole(format!("it has no `{name}`")),
            _ => self.wrong(format!("has no `{name}`")),
        })
    }

    /// The elements of a list; none if the field is missing.
    pub(super) fn list(&self, name: &str) -> Result<Vec<Self>, MeshError> {
        let Some(list) = self.get(name) else { return Ok(Vec::new()) };
        let elements = list.value.as_array().ok_or_else(|| list.wrong("is not a list"))?;
        let at = |(i, value): (usize, &'a Value)| Self { value, path: format!("{}[{i}]", list.path) };
        Ok(elements.iter().enumerate().map(at).collect())
    }

    /// One element of a list.
    pub(super) fn nth(&self, name: &str, index: usize) -> Option<Self> {
        let value = self.value.get(name)?.get(index)?;
        let dot = if self.path.is_empty() { "" } else { "." };
        Some(Self { value, path: format!("{}{dot}{name}[{index}]", self.path) })
    }

    /// The number of elements of a list; 0 if there is none.
    pub(super) fn count(&self, name: &str) -> usize {
        self.value.get(name).and_then(Value::as_array).map_or(0, Vec::len)
    }

    /// The element of a list of the whole file that an index field points to; `None` without the field.
    pub(super) fn refer(&self, name: &str, root: &Self, list: &str) -> Result<Option<usize>, MeshError> {
        let Some(index) = self.whole(name)? else { return Ok(None) };
        let count = root.count(list);
        match usize::try_from(index) {
            Ok(index) if index < count => Ok(Some(index)),
            _ => {
                let field = self.need(name)?;
                Err(field.wrong(format!("is {index}, but there are {count} {list}")))
            }
        }
    }

    /// One element of a list of the whole file.
    pub(super) fn element(&self, list: &str, index: usize) -> Result<Self, MeshError> {
        self.nth(list, index).ok_or_else(|| MeshError::whole(format!("it has no `{list}[{index}]`")))
    }

    /// A whole number from 0.
    pub(super) fn whole(&self, name: &str) -> Result<Option<u64>, MeshError> {
        let Some(field) = self.get(name) else { return Ok(None) };
        // Some exporters write whole numbers as `3.0`.
        let float = || field.value.as_f64().filter(|x| x.fract() == 0.0 && (0.0..=MOST as f64).contains(x));
        let number = field.value.as_u64().or_else(|| float().map(|x| x as u64));
        number
            .filter(|number| *number <= MOST)
            .map(Some)
            .ok_or_else(|| field.wrong("is not a whole number from 0"))
    }

    /// A number.
    pub(super) fn number(&self, name: &str) -> Result<Option<f64>, MeshError> {
        let Some(field) = self.get(name) else { return Ok(None) };
        let number = field.value.as_f64().filter(|x| x.is_finite());
        number.map(Some).ok_or_else(|| field.wrong("is not a number"))
    }

    /// Exactly `N` numbers.
    pub(super) fn numbers<const N: usize>(&self, name: &str) -> Result<Option<[f64; N]>, MeshError> {
        let Some(field) = self.get(name) else { return Ok(None) };
        let list = field.value.as_array().filter(|list| list.len() == N);
        let read = |list: &Vec<Value>| -> Option<Vec<f64>> { list.iter().map(Value::as_f64).collect() };
        let numbers = list.and_then(read).and_then(|numbers| <[f64; N]>::try_from(numbers).ok());
        numbers.map(Some).ok_or_else(|| field.wrong(format!("is not a list of {N} numbers")))
    }

    /// A text.
    pub(super) fn text(&self, name: &str) -> Result<Option<&'a str>, MeshError> {
        let Some(field) = self.get(name) else { return Ok(None) };
        field.value.as_str().map(Some).ok_or_else(|| field.wrong("is not a text"))
    }

    /// A text whose absence or wrong type does not matter: what something is called.
    pub(super) fn name(&self) -> Option<&'a str> {
        self.value.get("name").and_then(Value::as_str).filter(|name| !name.is_empty())
    }

    /// A yes or no; no if the field is missing.
    pub(super) fn flag(&self, name: &str) -> Result<bool, MeshError> {
        let Some(field) = self.get(name) else { return Ok(false) };
        field.value.as_bool().ok_or_else(|| field.wrong("is neither true nor false"))
    }

    /// The object that an extension adds.
    pub(super) fn extension(&self, name: &str) -> Option<Self> {
        self.get("extensions")?.get(name)
    }

    /// The names of the extensions that add something.
    pub(super) fn extensions(&self) -> Vec<&'a str> {
        let all = self.value.get("extensions").and_then(Value::as_object);
        all.into_iter().flat_map(|all| all.keys().map(String::as_str)).collect()
    }
}
