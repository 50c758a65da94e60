//! The tests that need two crates or more, or reference data: one program, so that they are linked once.

mod axis_parallel;
mod bodies;
mod book;
mod closure;
mod designs;
mod equilibrium;
mod frame3dd_example_b;
mod lanes_agree;
mod large_mechanisms;
mod lattices;
mod logan_gable_frame_p5_30;
mod logan_space_frame_example_5_8;
mod magnitudes;
mod natural_frequencies;
mod parallelogram_closed_form;
mod prebuilt_a;
mod prebuilt_b;
mod properties;
mod random_mechanisms;
mod reference_results;
mod refinement;
mod reordering;
mod single_freedom;
mod tapers;
mod traditional;
mod trajectories;
