#include "gfb_petsc.h"
!> Natural modes of a foil or a part of it.
module gfb_modes_analysis
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_memory_check, only: check_memory
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_results, only: add_result
  use gfb_result_table, only: all_modes_found, of_shifted_stiffness
  use gfb_petsc_session, only: wall_time, sum_over_ranks, largest_over_ranks, rank_count
  use gfb_c_library, only: peak_memory
  use gfb_scene, only: scene_type
  use gfb_modes_case, only: part_words, part_top_foil, part_strip
  use gfb_bump_foil_case, only: fixed_edge_none
  use gfb_shell_geometry, only: node_unknowns
  use gfb_foil_structure, only: foil_structure_type, destroy_foil_structure
  use gfb_foil_builder, only: foil_plan_type, build_part
  use gfb_foil_plan, only: plan_foil
  use gfb_eigenmodes, only: modes_type, lowest_modes, destroy_modes
  use gfb_mode_energies, only: free_motions, sharpen_modes, exact
  use gfb_craig_bampton, only: craig_bampton_type, craig_bampton
  use gfb_reduced_strip, only: assembled_eigenvalues
  use gfb_case_file, only: history_row_type, case_array_type, fill_array
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_foil_grid, only: create_foil_grid, add_displacement
  use gfb_provenance, only: provenance, blas_in_use
  implicit none (type)
  private
  public :: run_modes

  real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
  real(wp), parameter :: rigid = 1.0e-3_wp !! eigenvalues below this share of the plate's are rigid [1]

contains

  !> Computes the modes and writes the results.
  !>
  !> `converged` is false where fewer modes than wanted were found. Fails when a file cannot be
  !> written.
  subroutine run_modes(scene, folder, command, start_time, log, converged, error, answer)
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: folder   !! where the results go
    character(len=*), intent(in) :: command  !! the whole command line
    real(wp), intent(in) :: start_time       !! of the run [s]
    type(run_log_type), intent(in) :: log
    logical, intent(out) :: converged
    type(error_type), allocatable, intent(out) :: error
    type(quantity_type), allocatable, intent(out), optional :: answer(:) !! what the summary has

    type(foil_plan_type) :: plan
    type(foil_structure_type) :: part
    type(modes_type) :: modes, motions
    type(history_row_type), allocatable :: history(:)
    type(quantity_type), allocatable :: summary(:), reduced(:)
    type(case_array_type), allocatable :: arrays(:)
    type(result_grid_type) :: grid
    real(wp), allocatable :: moved(:, :)
    real(wp) :: shift, lost, left
    Mat :: mass
    PetscErrorCode :: ierr
    integer :: i

    call plan_foil(scene, log, plan)
    call check_memory(scene, plan%memory, error)
    if (allocated(error)) return
    call log%heading('solution')
    call build_part(scene, plan, part, error)
    if (allocated(error)) return
    call part%assemble_mass(mass, error)
    if (allocated(error)) return
    shift = plate_eigenvalue(part)
    call free_motions(part, mass, motions)
    call lowest_modes(PETSC_COMM_WORLD, part%stiffness, mass, shift, scene%modes%count, modes, motions)
    call destroy_modes(motions)
    call sharpen_modes(part, mass, rigid*shift, modes, lost, left, error)
    if (allocated(error)) return
    converged = size(modes%eigenvalue) >= min(scene%modes%count, part%unknowns)
    if (.not. converged) call log%gave_up('only '//text(size(modes%eigenvalue))//' modes found')
    call show_closing_block(log, scene, modes, part)
    call warn_of_round_off(log, lost, left, scene%modes%part == part_strip)
    call create_foil_grid(part, trim(merge('top_foil ', 'bump_foil', scene%modes%part == part_top_foil)), grid)
    allocate (moved(node_unknowns, size(part%part%mesh_node)))
    do i = 1, size(modes%shape)
      call part%displacements(modes%shape(i), moved)
      call add_displacement(part, 'mode_'//text(i), 'shape of unit modal mass', moved, grid)
    end do
    PetscCallA(MatDestroy(mass, ierr))
    allocate (arrays(0), reduced(0), history(1))
    if (scene%modes%part == part_strip) then
      call reduce_strip(part, scene%modes%substructure_modes, size(modes%eigenvalue), shift, log, arrays, &
                        reduced, error)
      if (allocated(error)) return
    end if
    call add_quantity(history(1)%quantity, mode_quantities(converged, modes, shift))
    call add_round_off(lost, left, history(1)%quantity)
    call add_quantity(history(1)%quantity, cost_quantities(part, start_time))
    call add_quantity(summary, history(1)%quantity)
    call add_quantity(summary, reduced)
    call destroy_modes(modes)
    call write_result_set(scene, folder, converged, provenance(command), summary, history, arrays, [grid], &
                          log, error)
    if (present(answer)) call move_alloc(summary, answer)
    call destroy_foil_structure(part)
  end subroutine run_modes

  !> Craig-Bampton matrices of the strip for the result file, and the frequencies they give.
  subroutine reduce_strip(strip, modes_kept, wanted, shift, log, arrays, frequencies, error)
    type(foil_structure_type), intent(in) :: strip
    integer, intent(in) :: modes_kept !! of every super-element
    integer, intent(in) :: wanted     !! frequencies
    real(wp), intent(in) :: shift     !! [1/s2]
    type(run_log_type), intent(in) :: log
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    type(quantity_type), allocatable, intent(inout) :: frequencies(:)
    type(error_type), allocatable, intent(out) :: error

    type(craig_bampton_type), allocatable :: kinds(:)
    real(wp), allocatable :: eigenvalue(:)
    integer :: i

    call craig_bampton(strip, modes_kept, kinds, error)
    if (allocated(error)) return
    eigenvalue = assembled_eigenvalues(strip, kinds, shift, wanted)
    call list_matrices(strip, kinds, arrays)
    do i = 1, size(eigenvalue)
      call add_result(frequencies, 'craig_bampton_frequency_'//text(i), sqrt(max(eigenvalue(i), 0.0_wp))/turn)
    end do
    call log%line('Craig-Bampton: '//text(size(kinds))//' kinds of super-element with '//text(modes_kept)// &
                  ' modes each, written to /craig_bampton')
  end subroutine reduce_strip

  !> The matrices of every kind, each on the rank that computed it, for the result file.
  subroutine list_matrices(strip, kinds, arrays)
    type(foil_structure_type), intent(in) :: strip
    type(craig_bampton_type), intent(inout) :: kinds(:) !! the matrices leave them
    type(case_array_type), allocatable, intent(out) :: arrays(:)
    integer :: i

    allocate (arrays(2*size(kinds) + 1))
    do i = 1, size(kinds)
      call add_matrix('stiffness', kinds(i)%stiffness, arrays(2*i - 1))
      call add_matrix('mass', kinds(i)%mass, arrays(2*i))
    end do
    call fill_array('/craig_bampton/kind_of_substructure', '1', 'kind of each super-element, from the smallest x on', &
                    reshape(real(strip%substructure%kind, wp), [1, size(strip%substructure)]), arrays(size(arrays)))

  contains

    !> One matrix of a kind.
    subroutine add_matrix(name, matrix, array)
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: matrix(:, :)
      type(case_array_type), intent(inout) :: array

      array%path = '/craig_bampton/kind_'//text(i)//'/'//name
      array%unit = 'mixed SI'
      array%meaning = 'retained unknowns, then modes'
      array%rows = kinds(i)%retained + kinds(i)%modes
      if (kinds(i)%mine) then
        call move_alloc(matrix, array%values)
      else
        allocate (array%values(array%rows, 0))
      end if
    end subroutine add_matrix
  end subroutine list_matrices

  !> Size of the lowest eigenvalue: that of a free plate as long as the mesh [1/s2].
  function plate_eigenvalue(part) result(eigenvalue)
    type(foil_structure_type), intent(in) :: part
    real(wp) :: eigenvalue
    real(wp) :: length, ends(4)

    associate (x => part%mesh%position(1, :), z => part%mesh%position(3, :), foil => part%section)
      ends = largest_over_ranks([maxval(x), -minval(x), maxval(z), -minval(z)])
      length = max(ends(1) + ends(2), ends(3) + ends(4))
      eigenvalue = foil%youngs_modulus*foil%thickness**2/(12.0_wp*(1.0_wp - foil%poissons_ratio**2)* &
                                                          foil%density*length**4)
    end associate
  end function plate_eigenvalue

  !> Quantities of the answer.
  function mode_quantities(converged, modes, shift) result(list)
    logical, intent(in) :: converged
    type(modes_type), intent(in) :: modes
    real(wp), intent(in) :: shift !! [1/s2]
    type(quantity_type), allocatable :: list(:)
    integer :: i

    call add_result(list, 'analysis', 'modes')
    call add_result(list, 'converged', converged, all_modes_found)
    do i = 1, size(modes%eigenvalue)
      call add_result(list, 'frequency_'//text(i), sqrt(max(modes%eigenvalue(i), 0.0_wp))/turn)
    end do
    call add_result(list, 'rigid_modes', count(abs(modes%eigenvalue) < rigid*shift))
  end function mode_quantities

  !> Quantities of what it cost.
  function cost_quantities(part, start_time) result(list)
    type(foil_structure_type), intent(in) :: part
    real(wp), intent(in) :: start_time !! [s]
    type(quantity_type), allocatable :: list(:)
    real(wp) :: memory(1)

    memory = sum_over_ranks([peak_memory()])
    call add_result(list, 'unknowns', part%unknowns)
    call add_result(list, 'factorizations', 1, of_shifted_stiffness)
    call add_result(list, 'wall_time', wall_time() - start_time)
    call add_result(list, 'peak_memory', memory(1))
  end function cost_quantities

  !> Adds what round-off leaves, where it is worth a word.
  subroutine add_round_off(lost, left, list)
    real(wp), intent(in) :: lost, left !! of the eigenvalues, as `sharpen_modes` has it [1]
    type(quantity_type), allocatable, intent(inout) :: list(:)

    if (lost > exact) call add_result(list, 'frequency_round_off', left)
  end subroutine add_round_off

  !> Says where the matrix had lost digits.
  subroutine warn_of_round_off(log, lost, left, reduced)
    type(run_log_type), intent(in) :: log
    real(wp), intent(in) :: lost, left !! of the eigenvalues [1]
    logical, intent(in) :: reduced     !! there is a reduced strip too

    if (.not. lost > exact) return
    call log%warning('the foil is so thin that round-off of its stretching stiffness moves frequencies by up to '// &
                     text(0.5_wp*lost, 2)//' of themselves; the energies of strains put them right, to about '// &
                     text(left, 2))
    if (reduced) call log%warning('the Craig-Bampton matrices and frequencies keep that round-off')
  end subroutine warn_of_round_off

  !> The answer in the units an engineer reads.
  subroutine show_closing_block(log, scene, modes, part)
    type(run_log_type), intent(in) :: log
    type(scene_type), intent(in) :: scene
    type(modes_type), intent(in) :: modes
    type(foil_structure_type), intent(in) :: part
    integer :: i

    call log%heading('answer')
    do i = 1, size(modes%eigenvalue)
      call log%line('mode '//text(i)//'  '//text(sqrt(max(modes%eigenvalue(i), 0.0_wp))/turn, 6)//' Hz')
    end do
    call log%line(trim(part_words(scene%modes%part))//' of '//text(part%unknowns)//' unknowns, '// &
                  text(rank_count())//' rank(s), BLAS '//blas_in_use())
  end subroutine show_closing_block
end module gfb_modes_analysis
