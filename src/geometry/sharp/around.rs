//! What is around vertices.

/// The triangles of each vertex.
pub(super) struct Around {
    starts: Vec<u32>,
    triangles: Vec<u32>,
}

impl Around {
    pub fn of(vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let mut starts = vec![0_u32; vertices + 1];
        triangles.iter().flatten().for_each(|vertex| starts[*vertex as usize + 1] += 1);
        for vertex in 0..vertices {
            starts[vertex + 1] += starts[vertex];
        }
        let (mut free, mut list) = (starts.clone(), vec![0; 3 * triangles.len()]);
        for (i, triangle) in triangles.iter().enumerate() {
            for vertex in triangle {
                list[free[*vertex as usize] as usize] = i as u32;
                free[*vertex as usize] += 1;
            }
        }
        Self { starts, triangles: list }
    }

    pub fn of_vertex(&self, vertex: u32) -> &[u32] {
        let vertex = vertex as usize;
        &self.triangles[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}

/// Marks on vertices, all of which a new mark takes away.
pub(super) struct Marks {
    of_vertices: Vec<u32>,
    mark: u32,
}

impl Marks {
    /// None yet.
    pub fn new(vertices: usize) -> Self {
        Self { of_vertices: vec![0; vertices], mark: 0 }
    }

    /// How many vertices are in both, each counted once, but for two.
    pub fn common(
        &mut self,
        first: impl Iterator<Item = u32>,
        second: impl Iterator<Item = u32>,
        but: [u32; 2],
    ) -> usize {
        self.mark += 2;
        first.for_each(|vertex| self.of_vertices[vertex as usize] = self.mark);
        let mut count = 0;
        for vertex in second.filter(|vertex| !but.contains(vertex)) {
            let mark = &mut self.of_vertices[vertex as usize];
            if *mark == self.mark {
                (*mark, count) = (self.mark + 1, count + 1);
            }
        }
        count
    }
}
