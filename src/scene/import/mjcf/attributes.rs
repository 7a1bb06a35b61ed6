//! Attributes of elements, their own or those of default classes.

use crate::import::{
    text::shorten,
    xml::{Xml, called, elements},
};
use base::error::InputError;
use roxmltree::Node;
use std::collections::HashMap;

/// Default classes: each with its parent's number and its sections of the file.
#[derive(Default)]
pub(super) struct Classes<'a, 'i> {
    list: Vec<(Option<usize>, Vec<Node<'a, 'i>>)>,
    numbers: HashMap<&'a str, usize>,
}

impl<'a, 'i> Classes<'a, 'i> {
    /// Those of a model.
    ///
    /// # Errors
    /// A class in a class without a name.
    pub fn read(xml: &Xml, model: Node<'a, 'i>) -> Result<Self, InputError> {
        let mut classes = Self::default();
        // The class of everything: all sections at the top belong to it.
        classes.list.push((None, Vec::new()));
        for section in elements(model).filter(|n| n.has_tag_name("default")) {
            classes.numbers.insert(section.attribute("class").unwrap_or("main"), 0);
            classes.list[0].1.push(section);
            classes.inner(xml, section, 0)?;
        }
        Ok(classes)
    }

    fn inner(&mut self, xml: &Xml, of: Node<'a, 'i>, parent: usize) -> Result<(), InputError> {
        for section in elements(of).filter(|n| n.has_tag_name("default")) {
            let name = section.attribute("class").ok_or_else(|| {
                xml.error(section, "a default class without a name").hint("add class=\"NAME\"")
            })?;
            let number = self.list.len();
            self.numbers.insert(name, number);
            self.list.push((Some(parent), vec![section]));
            self.inner(xml, section, number)?;
        }
        Ok(())
    }

    /// The number of a class by its name.
    ///
    /// # Errors
    /// There is none.
    pub fn number(&self, xml: &Xml, node: Node, name: &str) -> Result<usize, InputError> {
        self.numbers.get(name).copied().ok_or_else(|| {
            xml.error(node, format!("no default class is called {:?}", shorten(name)))
                .hint("classes stand in the section <default>")
        })
    }

    /// The attributes of an element; `inherited` is the class that its bodies choose.
    ///
    /// # Errors
    /// It names a class that there is not.
    pub fn of<'x>(
        &'x self,
        xml: &Xml,
        node: Node<'a, 'i>,
        inherited: usize,
    ) -> Result<Attributes<'x, 'a, 'i>, InputError> {
        let class = match node.attribute("class") {
            Some(name) => self.number(xml, node, name)?,
            None => inherited,
        };
        Ok(Attributes { node, class, classes: self })
    }
}

/// Attributes of one element.
#[derive(Clone, Copy)]
pub(super) struct Attributes<'x, 'a, 'i> {
    pub node: Node<'a, 'i>,
    class: usize,
    classes: &'x Classes<'a, 'i>,
}

impl<'a, 'i> Attributes<'_, 'a, 'i> {
    /// Where an attribute stands: the element, or the nearest default.
    fn bearer(&self, names: &[&str]) -> Option<Node<'a, 'i>> {
        let has = |n: &Node| names.iter().any(|name| n.has_attribute(*name));
        if has(&self.node) {
            return Some(self.node);
        }
        let tag = self.node.tag_name();
        let mut next = Some(self.class);
        while let Some((parent, sections)) = next.and_then(|k| self.classes.list.get(k)) {
            let inside = sections.iter().rev().flat_map(|s| elements(*s));
            if let Some(found) = inside.filter(|n| n.tag_name() == tag).find(has) {
                return Some(found);
            }
            next = *parent;
        }
        None
    }

    /// Its value.
    pub fn get(&self, name: &str) -> Option<&'a str> {
        self.bearer(&[name]).and_then(|n| n.attribute(name))
    }

    /// The first of several that exclude each other, at the nearest place that has one.
    pub fn one_of<'n>(&self, names: &[&'n str]) -> Option<(&'n str, &'a str)> {
        let bearer = self.bearer(names)?;
        names.iter().find_map(|name| Some((*name, bearer.attribute(*name)?)))
    }

    /// So many finite numbers as `counts` allows.
    ///
    /// # Errors
    /// Other words, or another number of them.
    pub fn numbers(
        &self,
        xml: &Xml,
        name: &str,
        counts: std::ops::RangeInclusive<usize>,
    ) -> Result<Option<Vec<f64>>, InputError> {
        let Some(text) = self.get(name) else { return Ok(None) };
        let what = format!("{}: {name}", called(self.node));
        xml.numbers(self.node, &what, text, counts).map(Some)
    }

    /// One finite number.
    ///
    /// # Errors
    /// As for [`Self::numbers`].
    pub fn number(&self, xml: &Xml, name: &str) -> Result<Option<f64>, InputError> {
        Ok(self.numbers(xml, name, 1..=1)?.map(|list| list[0]))
    }

    /// A whole number.
    ///
    /// # Errors
    /// As for [`Self::numbers`].
    pub fn whole(&self, xml: &Xml, name: &str) -> Result<Option<i64>, InputError> {
        // Beyond what fits the nearest, which no file means.
        Ok(self.number(xml, name)?.map(|v| v as i64))
    }
}
