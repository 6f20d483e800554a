!> `reduction = 'auto'`: bumps are condensed or not, whichever costs less.
!>
!> Operations and memory are counted before anything is built, from the mesh alone. The laws are
!> fitted to MUMPS' counts of 16 scenes, which docs/manual/linear_solvers.md has in a table.
module gfb_reduction_choice
  use gfb_kinds, only: wp
  use gfb_bump_foil_case, only: sizes_mirror
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_strip, analysis_modes
  use gfb_scene_rules, only: is_symmetric
  use gfb_model_case, only: foil_shell, reduction_guyan, reduction_none, reduction_auto, &
                            half_width_auto, half_width_yes
  use gfb_solver_case, only: linear_solver_iterative
  use gfb_shell_geometry, only: node_unknowns
  use gfb_foil_plan, only: count_bumps, has_friction
  use gfb_memory_check, only: strip_memory, bearing_memory, factor_entries
  implicit none (type, external)
  private
  public :: choose_reduction, reduction_cost

  !> What a model takes, about.
  type, public :: reduction_cost_type
    real(wp) :: work = 0.0_wp   !! operations, or what takes as long as one [1]
    real(wp) :: memory = 0.0_wp !! of the equations [B]
  end type reduction_cost_type

  !> Of one factorization, one triangular solve and one product with the matrix.
  type :: size_type
    real(wp) :: operations = 0.0_wp !! of a factorization [1]
    real(wp) :: factors = 0.0_wp    !! entries [1]
    real(wp) :: matrix = 0.0_wp     !! entries of the foil's rows [1]
  end type size_type

  !> How often they are needed.
  type :: count_type
    real(wp) :: factorizations, solves, products, matrices !! [1]
  end type count_type

  real(wp), parameter :: a_solve = 10.0_wp   !! operations as long as an entry in a solve [1]
  real(wp), parameter :: a_factor = 60.0_wp  !! the same of an entry that is factored [1]
  real(wp), parameter :: a_copy = 20.0_wp    !! of an entry in an assembly [1]
  real(wp), parameter :: an_entry = 500.0_wp !! of an entry in the set-up [1]
  real(wp), parameter :: full_row = 45.0_wp  !! entries of a row: its node and eight neighbours [1]
  real(wp), parameter :: alike = 0.05_wp     !! of works: memory decides [1]
  real(wp), parameter :: megabyte = 1.0e6_wp !! [B]

contains

  !> Replaces 'auto' by what costs less, with the reason in words.
  subroutine choose_reduction(scene)
    type(scene_type), intent(inout) :: scene !! gets its reduction, if it asks for a choice
    type(reduction_cost_type) :: condensed, full
    logical :: better

    if (scene%model%reduction /= reduction_auto) return
    if (scene%model%foil /= foil_shell .or. scene%general%analysis == analysis_modes) then
      scene%model%reduction = reduction_guyan ! nothing asks for it
      return
    end if
    condensed = reduction_cost(scene, .true.)
    full = reduction_cost(scene, .false.)
    better = condensed%work < full%work
    if (abs(condensed%work - full%work) <= alike*max(condensed%work, full%work)) then
      better = condensed%memory < full%memory
    end if
    if (scene%solver%linear_solver == linear_solver_iterative) then
      scene%model%reduction = reduction_none
      scene%model%reduction_reason = "all unknowns, because linear_solver is 'iterative'"
    else if (better) then
      scene%model%reduction = reduction_guyan
      scene%model%reduction_reason = 'condensed, because that takes about '// &
                                     in_words(condensed)//'; all unknowns '//in_words(full)
    else
      scene%model%reduction = reduction_none
      scene%model%reduction_reason = 'all unknowns, because they take about '// &
                                     in_words(full)//'; condensed '//in_words(condensed)
    end if
  end subroutine choose_reduction

  !> A cost in words.
  pure function in_words(cost) result(words)
    type(reduction_cost_type), intent(in) :: cost
    character(len=:), allocatable :: words
    words = text(cost%work, 2)//' operations and '//text(cost%memory/megabyte, 3)// &
            ' MB of matrices'
  end function in_words

  !> What a scene of shells takes with its bumps condensed, or with all unknowns.
  pure function reduction_cost(scene, reduced) result(cost)
    type(scene_type), intent(in) :: scene !! a strip, or a bearing of shells
    logical, intent(in) :: reduced !! bumps are condensed
    type(reduction_cost_type) :: cost
    type(size_type) :: sizes
    type(count_type) :: counts
    real(wp) :: unknowns
    integer :: rows, stations, nodes

    rows = solved_rows(scene)
    call count_bumps(scene, rows, reduced, stations, unknowns)
    if (scene%general%analysis == analysis_strip) then
      sizes = strip_sizes(unknowns, stations, rows, reduced, has_friction(scene))
      counts = strip_counts(scene)
      cost%memory = strip_memory(unknowns, stations, rows, reduced, has_friction(scene), &
                                 scene%solver%linear_solver)
    else
      sizes = bearing_sizes(scene, unknowns, rows, reduced)
      counts = bearing_counts(scene)
      nodes = (scene%model%film_order*scene%mesh%circumferential_elements + 1)*rows
      cost%memory = bearing_memory(nodes, unknowns, rows, reduced, &
                                   scene%solver%linear_solver)
    end if
    cost%work = counts%factorizations*(sizes%operations + a_factor*sizes%factors) + &
                a_solve*(counts%solves*sizes%factors + counts%products*sizes%matrix) + &
                (an_entry + a_copy*counts%matrices)*sizes%matrix
  end function reduction_cost

  !> Rows of nodes that are solved.
  pure function solved_rows(scene) result(rows)
    type(scene_type), intent(in) :: scene
    integer :: rows
    logical :: half

    half = scene%model%half_width == half_width_yes
    if (scene%model%half_width == half_width_auto) then
      half = modulo(scene%mesh%axial_elements, 2) == 0 .and. sizes_mirror(scene%bump_foil)
      if (scene%general%analysis /= analysis_strip) then
        half = half .and. is_symmetric(scene%operation, scene%sweep)
      end if
    end if
    associate (whole => scene%mesh%axial_elements)
      rows = scene%model%film_order*merge(whole/2, whole, half) + 1
    end associate
  end function solved_rows

  !> A strip: condensed, a chain of dense lines; else a grid that is dissected into squares.
  pure function strip_sizes(unknowns, stations, rows, reduced, friction) result(sizes)
    real(wp), intent(in) :: unknowns !! [1]
    integer, intent(in) :: stations, rows
    logical, intent(in) :: reduced, friction
    type(size_type) :: sizes
    real(wp), parameter :: a_line = 4.5_wp   !! operations over the cube of a line's unknowns [1]
    real(wp), parameter :: a_square = 47.0_wp !! the same of a square of the grid [1]
    real(wp) :: line, shorter, longer

    line = real(node_unknowns*rows, wp)
    if (reduced) then
      sizes = size_type(a_line*unknowns*line**2, 3.0_wp*unknowns*line, &
                        3.0_wp*unknowns*line)
    else
      shorter = real(min(stations, rows), wp)
      longer = real(max(stations, rows), wp)
      sizes = size_type(a_square*(longer/shorter + 0.5_wp)*(node_unknowns*shorter)**3, &
                        2.0_wp*unknowns*factor_entries(stations, rows), full_row*unknowns)
    end if
    if (.not. friction) then ! one triangle
      sizes%operations = 0.5_wp*sizes%operations
      sizes%factors = 0.5_wp*sizes%factors
    end if
  end function strip_sizes

  !> A bearing: both foils and the film over them, pitch by pitch.
  pure function bearing_sizes(scene, unknowns, rows, reduced) result(sizes)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: unknowns !! of the bump foil [1]
    integer, intent(in) :: rows
    logical, intent(in) :: reduced
    type(size_type) :: sizes
    !> Of a bump: condensed; with all unknowns; and more with the elements of a pitch over the rows.
    real(wp), parameter :: operations(3) = [75.0_wp, 45.0_wp, 65.0_wp]
    real(wp), parameter :: entries(3) = [31.0_wp, 22.0_wp, 35.0_wp]
    real(wp) :: line, length

    line = real(node_unknowns*rows, wp)
    associate (bumps => real(scene%bump_foil%bumps, wp))
      if (reduced) then
        sizes = size_type(operations(1)*bumps*line**3, entries(1)*bumps*line**2, &
                          3.0_wp*unknowns*line)
      else
        length = unknowns/(bumps*line*rows) ! elements of a pitch, over the rows
        sizes = size_type((operations(2) + operations(3)*length)*bumps*line**3, &
                          (entries(2) + entries(3)*length)*bumps*line**2, full_row*unknowns)
      end if
    end associate
  end function bearing_sizes

  !> Friction takes a few factorizations and many solves; without it one factorization will do.
  pure function strip_counts(scene) result(counts)
    type(scene_type), intent(in) :: scene
    type(count_type) :: counts
    real(wp) :: steps

    counts = count_type(1.0_wp, 6.0_wp, 6.0_wp, 3.0_wp)
    if (.not. has_friction(scene)) return
    steps = real(scene%strip_load%steps_up + scene%strip_load%steps_down, wp)
    counts = count_type(3.0_wp, 45.0_wp*steps, 45.0_wp*steps, 7.0_wp*steps)
  end function strip_counts

  !> A cold start takes 30 factorizations, a point of a sweep 3 more; a solve each and a half.
  pure function bearing_counts(scene) result(counts)
    type(scene_type), intent(in) :: scene
    type(count_type) :: counts
    real(wp) :: factorizations

    factorizations = 30.0_wp
    if (scene%sweep%present) factorizations = factorizations + 3.0_wp*size(scene%sweep%values)
    counts = count_type(factorizations, 1.4_wp*factorizations, 0.0_wp, 1.4_wp*factorizations)
  end function bearing_counts
end module gfb_reduction_choice
