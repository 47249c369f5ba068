//! Pages of menus, read from files.

use super::Setting;
use crate::input::Action;
use crate::shipped;
use serde::Deserialize;

/// A page: what stands in it, and where it leads.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// Its name: that of its file.
    pub name: String,
    /// The key of its title in the texts.
    pub title: String,
    /// The lines, from above.
    pub items: Vec<Item>,
}

/// A line of a page.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// The key of its text.
    pub text: String,
    /// What choosing it does.
    pub effect: Effect,
}

/// What a line is there for.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// It leads to another page.
    Opens(String),
    /// It does something.
    Does(Act),
    /// It sets something.
    Sets(Setting),
    /// It says which keys an action has, and changes them.
    Binds(Action),
}

/// What a line can do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Act {
    /// Back to the page before.
    Back,
    /// A game begins, as it is set.
    Start,
    /// The same game begins again.
    Again,
    /// The game in which a beginner learns to play begins.
    Tutorial,
    /// The last shot is seen again.
    Replay,
    /// The game goes on.
    Resume,
    /// The game ends, and the main menu opens.
    Leave,
    /// The program ends.
    Quit,
    /// All keys are as they are shipped.
    UsualKeys,
}

/// All pages.
#[derive(Debug, Clone, PartialEq)]
pub struct Pages(Vec<Page>);

/// What is wrong with a page; one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PageError {
    /// It is no TOML, or has a key that no page has.
    #[error("config/menus/{page}.toml: {problem}")]
    Form {
        /// Which.
        page: String,
        /// What the parser says, with the line.
        problem: String,
    },
    /// A line with no effect, or with several.
    #[error(
        "config/menus/{page}.toml: item {item} ({text:?}) needs one of 'opens', 'does', 'sets' and \
         'binds'"
    )]
    Effects {
        /// Which page.
        page: String,
        /// Which line, counted from 1.
        item: usize,
        /// Its text.
        text: String,
    },
    /// A line that leads nowhere.
    #[error("config/menus/{page}.toml: item {item} opens {target:?}, but the pages are {known}")]
    NoPage {
        /// Which page.
        page: String,
        /// Which line, counted from 1.
        item: usize,
        /// Where it leads.
        target: String,
        /// Where it may lead.
        known: String,
    },
    /// A line for an action that there is not.
    #[error("config/menus/{page}.toml: item {item} binds {name:?}, which is no action")]
    NoAction {
        /// Which page.
        page: String,
        /// Which line, counted from 1.
        item: usize,
        /// What it names.
        name: String,
    },
    /// A page without lines: nobody would come out of it.
    #[error("config/menus/{page}.toml: a page needs at least one [[item]]")]
    Empty {
        /// Which.
        page: String,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PageForm {
    title: String,
    #[serde(default)]
    item: Vec<ItemForm>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ItemForm {
    /// A line that binds has its action's.
    #[serde(default)]
    text: String,
    opens: Option<String>,
    does: Option<Act>,
    sets: Option<Setting>,
    binds: Option<String>,
}

impl Pages {
    /// The pages that are shipped.
    ///
    /// # Errors
    /// What is wrong with one of them; a test reads them all.
    pub fn shipped() -> Result<Self, PageError> {
        Self::parse(shipped::MENUS)
    }

    /// Pages of files: names and texts.
    ///
    /// # Errors
    /// [`PageError`]: which page, which line, and what is allowed there.
    pub fn parse(files: &[(&str, &str)]) -> Result<Self, PageError> {
        let pages: Result<Vec<Page>, PageError> =
            files.iter().map(|(name, text)| page(name, text)).collect();
        let pages = Pages(pages?);
        for page in &pages.0 {
            for (n, item) in page.items.iter().enumerate() {
                if let Effect::Opens(target) = &item.effect
                    && pages.place_of(target).is_none()
                {
                    let known: Vec<_> = pages.0.iter().map(|page| page.name.as_str()).collect();
                    return Err(PageError::NoPage {
                        page: page.name.clone(),
                        item: n + 1,
                        target: target.clone(),
                        known: known.join(", "),
                    });
                }
            }
        }
        Ok(pages)
    }

    /// The page of a name.
    pub fn get(&self, name: &str) -> Option<&Page> {
        self.0.iter().find(|page| page.name == name)
    }

    /// All of them, in the order of the files.
    pub fn iter(&self) -> impl Iterator<Item = &Page> {
        self.0.iter()
    }

    pub(super) fn place_of(&self, name: &str) -> Option<usize> {
        self.0.iter().position(|page| page.name == name)
    }

    pub(super) fn at(&self, place: usize) -> Option<&Page> {
        self.0.get(place)
    }
}

fn page(name: &str, text: &str) -> Result<Page, PageError> {
    let form: PageForm = toml::from_str(text).map_err(|error| PageError::Form {
        page: name.into(),
        problem: crate::one_line::one_line(&error.to_string(), 400),
    })?;
    let items: Result<Vec<Item>, PageError> =
        form.item.into_iter().enumerate().map(|(n, item)| self::item(name, n + 1, item)).collect();
    let items = items?;
    if items.is_empty() {
        return Err(PageError::Empty { page: name.into() });
    }
    Ok(Page { name: name.into(), title: form.title, items })
}

fn item(page: &str, number: usize, form: ItemForm) -> Result<Item, PageError> {
    let ItemForm { text, opens, does, sets, binds } = form;
    let no_action = |name: &str| {
        let (page, name) = (page.into(), crate::one_line::one_line(name, 40));
        PageError::NoAction { page, item: number, name }
    };
    let named = |name: &str| Action::named(name).ok_or_else(|| no_action(name));
    let binds = binds.as_deref().map(named).transpose()?;
    let text = binds.map_or(text, |action| format!("action_{}", action.name()));
    let effects = [
        opens.map(Effect::Opens),
        does.map(Effect::Does),
        sets.map(Effect::Sets),
        binds.map(Effect::Binds),
    ];
    let mut effects = effects.into_iter().flatten();
    match (effects.next(), effects.next()) {
        (Some(effect), None) => Ok(Item { text, effect }),
        _ => Err(PageError::Effects { page: page.into(), item: number, text }),
    }
}
