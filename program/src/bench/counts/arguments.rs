//! The options of `surfel bench counts`.

use clap::Args;

/// Options of `surfel bench counts` alone.
#[derive(Args)]
#[command(next_help_heading = "counts")]
pub struct CountsArguments {
    /// Every pipeline: ellipses, open surfaces and psi_e too, lists of large splats, weights, 32-bit sums, shadings [default: small disks]
    #[arg(long)]
    pub all: bool,

    /// What compilers of these chips make of every pipeline: RADV's names, such as NAVI21 (RDNA2), VEGA10 (GCN 5), POLARIS10,
    /// GFX1100; or `here` for the device of this machine. No such chip is needed, but RADV (package mesa-vulkan-drivers)
    #[arg(long, value_name = "CHIP,...", value_delimiter = ',')]
    pub isa: Vec<String>,

    /// Print the rows of this machine's device as JSON: for a process of ours, one a chip
    #[arg(long, hide = true)]
    pub isa_rows: bool,
}
