//! Patterns that the renderer spells out and ARB has as one instruction: MAD, DP3, DP4 and XPD, found in the graph of values.

use std::collections::HashMap;

use rspirv::{
    dr::Instruction,
    spirv::{GlslStd450Op, Op},
};

use super::{
    arb::extended_op,
    live::Live,
    module::{Id, ids},
    numbering::Scalar,
    specialize::Specialized,
};

/// The part of an instruction in a pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// All of the pattern's cost, under this name.
    Whole(&'static str),
    /// A part without a cost of its own.
    Part,
    /// The product in a MAD.
    Factor,
}

/// Every instruction that is in a pattern. The largest patterns are looked for first, from the results to the inputs.
pub fn find(specialized: &Specialized<'_>, live: &Live<'_>) -> HashMap<Id, Pattern> {
    let mut finder = Finder { specialized, live, found: HashMap::new() };
    let sums: Vec<&Instruction> = live
        .instructions
        .iter()
        .rev()
        .map(|(_, instruction)| *instruction)
        .filter(|instruction| matches!(kind(instruction), Some(Kind::Sum | Kind::Fused)))
        .collect();
    for sum in &sums {
        finder.cross(sum);
        finder.dot(sum);
    }
    for sum in &sums {
        finder.multiply_add(sum);
    }
    finder.found
}

struct Finder<'s, 'a> {
    specialized: &'s Specialized<'a>,
    live: &'s Live<'a>,
    found: HashMap<Id, Pattern>,
}

/// A product in a sum.
struct Product {
    /// The instructions that are it.
    parts: Vec<Id>,
    factors: [Vec<Scalar>; 2],
    negative: bool,
}

/// A sum taken apart.
struct Sum {
    products: Vec<Product>,
    /// The sums within it.
    parts: Vec<Id>,
}

impl<'a> Finder<'_, 'a> {
    /// The instruction whose whole result a value is, in order and used by nothing else; and whether it is negated, which is
    /// free.
    fn only_used_here(&self, id: Id) -> Option<(&'a Instruction, bool)> {
        let scalars = self.specialized.scalars(id);
        let Some(Scalar::Of(source, 0)) = scalars.first() else { return None };
        let in_order = scalars.iter().zip(0..).all(|(scalar, i)| *scalar == Scalar::Of(*source, i));
        let width = self.specialized.module.width_of(*source) as usize;
        let users = self.live.users.get(source)?;
        let instruction = self.specialized.instruction(*source)?;
        if !in_order || width != scalars.len() || users.len() != 1 || self.found.contains_key(source) {
            return None;
        }
        match instruction.class.opcode {
            Op::FNegate => {
                let (instruction, negative) = self.only_used_here(ids(instruction).next()?)?;
                Some((instruction, !negative))
            }
            _ => Some((instruction, false)),
        }
    }

    /// The scalars of a factor, and whether it is negated.
    fn factor(&self, id: Id) -> (Vec<Scalar>, bool) {
        match self.specialized.instruction(self.specialized.resolve(id)) {
            Some(instruction) if instruction.class.opcode == Op::FNegate => {
                let (scalars, negative) = self.factor(ids(instruction).next().unwrap_or_default());
                (scalars, !negative)
            }
            _ => (self.specialized.scalars(id), false),
        }
    }

    fn product(&self, parts: Vec<Id>, [a, b]: [Id; 2], negative: bool) -> Product {
        let ((a, a_negative), (b, b_negative)) = (self.factor(a), self.factor(b));
        Product { parts, factors: [a, b], negative: negative ^ a_negative ^ b_negative }
    }

    /// A sum of nothing but products, taken apart.
    fn sum_of_products(&self, sum: &Instruction) -> Option<Sum> {
        let mut apart = Sum { products: Vec::new(), parts: Vec::new() };
        let mut open: Vec<(&Instruction, bool)> = vec![(sum, false)];
        while let Some((instruction, negative)) = open.pop() {
            let id = instruction.result_id?;
            let operands: Vec<Id> = ids(instruction).collect();
            let addends = match (kind(instruction), operands.as_slice()) {
                (Some(Kind::Sum), [a, b]) => {
                    apart.parts.push(id);
                    vec![(*a, negative), (*b, negative ^ (instruction.class.opcode == Op::FSub))]
                }
                (Some(Kind::Fused), [_, a, b, c]) => {
                    apart.parts.push(id);
                    apart.products.push(self.product(Vec::new(), [*a, *b], negative));
                    vec![(*c, negative)]
                }
                (Some(Kind::Product), [a, b]) => {
                    apart.products.push(self.product(vec![id], [*a, *b], negative));
                    Vec::new()
                }
                _ => return None,
            };
            for (addend, negative) in addends {
                let (instruction, turned) = self.only_used_here(addend)?;
                open.push((instruction, negative ^ turned));
            }
        }
        Some(apart)
    }

    fn take(&mut self, id: Id, name: &'static str, sum: &Sum) {
        let parts = sum.products.iter().flat_map(|product| &product.parts).chain(&sum.parts);
        self.found.extend(parts.map(|part| (*part, Pattern::Part)));
        self.found.insert(id, Pattern::Whole(name));
    }

    /// a.yzx * b.zxy - a.zxy * b.yzx.
    fn cross(&mut self, instruction: &Instruction) -> Option<()> {
        let id = instruction.result_id?;
        if self.found.contains_key(&id) || self.specialized.module.width_of(id) != 3 {
            return None;
        }
        let sum = self.sum_of_products(instruction)?;
        let [first, second] = sum.products.as_slice() else { return None };
        let ([a, b], [c, d]) = (&first.factors, &second.factors);
        let of_one_register =
            |scalars: &[Scalar]| scalars.iter().all(|scalar| scalar.register() == scalars[0].register());
        // From a.yzx and b.zxy follow a.zxy and b.yzx: turned by one place.
        let turned = |scalars: &[Scalar]| vec![scalars[1], scalars[2], scalars[0]];
        let turned_back = |scalars: &[Scalar]| vec![scalars[2], scalars[0], scalars[1]];
        let is_cross = |c: &[Scalar], d: &[Scalar]| {
            (c == turned(a) && d == turned_back(b)) || (c == turned_back(a) && d == turned(b))
        };
        let fits = is_cross(c, d) || is_cross(d, c);
        if first.negative == second.negative || !fits || !of_one_register(a) || !of_one_register(b) {
            return None;
        }
        self.take(id, "XPD", &sum);
        Some(())
    }

    /// a.x * b.x + a.y * b.y, with up to four products.
    fn dot(&mut self, instruction: &Instruction) -> Option<()> {
        let id = instruction.result_id?;
        if self.found.contains_key(&id) || self.specialized.module.width_of(id) != 1 {
            return None;
        }
        let sum = self.sum_of_products(instruction)?;
        let first = sum.products.first()?;
        let registers = |product: &Product| {
            let [x, y] = &product.factors;
            [x[0].register(), y[0].register()]
        };
        let [a, b] = registers(first);
        let fits = |product: &Product| {
            let [x, y] = registers(product);
            product.negative == first.negative && ([x, y] == [a, b] || [x, y] == [b, a])
        };
        if a.is_none() || b.is_none() || sum.products.len() > 4 || !sum.products.iter().all(fits) {
            return None;
        }
        self.take(id, if sum.products.len() <= 3 { "DP3" } else { "DP4" }, &sum);
        Some(())
    }

    /// A sum with a product, or a quotient, that nothing else uses.
    fn multiply_add(&mut self, sum: &Instruction) -> Option<()> {
        let id = sum.result_id?;
        if self.found.contains_key(&id) || kind(sum) != Some(Kind::Sum) {
            return None;
        }
        let product = ids(sum).find_map(|term| {
            let (instruction, _) = self.only_used_here(term)?;
            let multiplies = matches!(instruction.class.opcode, Op::FMul | Op::VectorTimesScalar | Op::FDiv);
            let one = Scalar::Known(1.0_f32.to_bits());
            let is_reciprocal = instruction.class.opcode == Op::FDiv
                && ids(instruction).next().is_some_and(|numerator| {
                    self.specialized.scalars(numerator).iter().all(|scalar| *scalar == one)
                });
            (multiplies && !is_reciprocal).then_some(instruction.result_id).flatten()
        })?;
        self.found.extend([(id, Pattern::Whole("MAD")), (product, Pattern::Factor)]);
        Some(())
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Sum,
    Product,
    /// A product and a sum: compilers make them where nothing forbids it.
    Fused,
}

fn kind(instruction: &Instruction) -> Option<Kind> {
    match instruction.class.opcode {
        Op::FAdd | Op::FSub => Some(Kind::Sum),
        Op::FMul => Some(Kind::Product),
        Op::ExtInst if extended_op(instruction) == Some(GlslStd450Op::Fma) => Some(Kind::Fused),
        _ => None,
    }
}
