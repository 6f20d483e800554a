#include "gfb_petsc.h"
!> How the film's force and torque follow a vibration of the shaft, at an answer.
!>
!> The bearing's equations in time are \( f(x, q) + \frac{d}{dt} c(x, q) = 0 \), with those of the shaft's
!> coordinates q given that move the film: \( (e_x, e_y, \phi_x, \phi_y) \) of a journal, \( (e_z, \phi_x, \phi_y) \) of a runner. A motion \( q' e^{i \omega t} \) is answered by
!>
!> $$ (f_x + i \omega c_x) x' = -(f_q + i \omega c_q) q', $$
!>
!> and the force of the film by the pressures in \( x' \): \( Z_{jk} = K_{jk} + i \omega C_{jk} =
!> -\int p'_k B_j \, dA \) with \( B_j = \partial h/\partial q_j \). A positive diagonal restores, and
!> damps.
!>
!> On half the width translations have the symmetry of the steady state, tilts
!> the opposite one: their pressures vanish at z = 0, and foils that feel the mean pressure stay. Shells and plates
!> move against their mirror then: they are a bearing of their own, with other supports at z = 0.
!>
!> What motions of the shaft are felt by, and what they move, given their symmetry about z = 0.
!>
!> On half the width a bearing has motions of two symmetries: those of the steady state, and those
!> against the other half's mirror, whose pressures vanish at z = 0. Tilts are of the second kind.
module gfb_dynamic_response
  use petscmat
  use gfb_kinds, only: wp
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_units, only: turn
  use gfb_bearing_system, only: bearing_system_type
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_film_feed, only: mouth_unknowns
  use gfb_film_surface, only: shaft_coordinates, all_translations => translations
  use gfb_film_load, only: acts_on
  use gfb_pad, only: pad_type
  use gfb_contacts_in_motion, only: stick_contacts
  use gfb_pad_contacts, only: linearise_exactly
  use gfb_film_rates, only: squeeze_column
  use gfb_bearing_motion, only: add_vibrations
  use gfb_vibration_law, only: vibration_type
  use gfb_vibration_equations, only: vibration_equations_type, combine, combine_rate, release_sums, destroy_equations
  use gfb_complex_solver, only: complex_solver_type, keep_entries
  use gfb_complex_factors, only: complex_factors_type, create_complex_factors
  use gfb_complex_iterations, only: complex_iterations_type, create_complex_iterations
  implicit none (type)
  private
  public :: linearise_steady, measure_asperities, create_response, find_coefficients, find_sample, release_parts, take_over_counts, response_failure, &
            prepare_part, solve_part, forces_of, force_gradient, destroy_response

  !> Of a journal's motions.
  integer, parameter :: translations(2) = [1, 2], tilts(2) = [3, 4]

  !> The equations of motions with one symmetry about z = 0, or of all.
  type :: part_type
    integer, allocatable :: coordinate(:) !! of the response's motions, those that have it
    real(wp), allocatable :: weight(:, :) !! (coordinates, film nodes) B_j dA, this rank's [m2], [m3]
    logical, allocatable :: kept(:)       !! owned unknowns that such a motion has
    class(complex_solver_type), allocatable :: solver
  end type part_type

  !> Complex vectors, one a motion.
  type, public :: motion_vectors_type
    type(tVec), allocatable :: re(:), im(:)
  end type motion_vectors_type

  !> The linearised bearing.
  type, public :: dynamic_response_type
    integer :: factorizations = 0 !! so far
    integer :: enlargements = 0   !! of the factors' workspace
    integer :: status = 0         !! of the last solver that was prepared, negative where it cannot solve
    type(run_log_type) :: log     !! where lines of progress go; without a memory none are written
    integer, allocatable :: motion(:) !! of the shaft's coordinates, those that move the film
    type(vibration_equations_type) :: equations
    type(part_type), allocatable :: part(:)
    type(tVec) :: steady_column(shaft_coordinates), squeeze_column(shaft_coordinates) !! of the motions, the first ones
    type(motion_vectors_type) :: change !! minus that of the unknowns, by each motion that was solved for last
    type(motion_vectors_type) :: rise !! its derivative by lambda, where that was asked for
    type(tVec) :: one, other !! work space
    type(bearing_system_type), allocatable :: opposite_bearing !! of tilts, where its foil is another
    type(dynamic_response_type), allocatable :: opposite       !! of that
    real(wp), allocatable, private :: solid_rate(:) !! slope of the asperities' pressure over the gap [Pa/m]
  end type dynamic_response_type

contains

  !> \( B_j \, dA \) of motions at the film nodes of all pads.
  pure function motion_weights(bearing, coordinate) result(weight)
    type(bearing_system_type), intent(in) :: bearing !! that vibrates
    integer, intent(in) :: coordinate(:) !! of the motions; on half the width of one symmetry, or all
    real(wp) :: weight(size(coordinate), bearing%film_nodes()) !! this rank's [m2], [m3]
    integer, allocatable :: moved(:)
    integer :: i, k

    moved = bearing%mesh%surface%motions()
    moved = moved(coordinate)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), film => bearing%pad(i)%film)
        if (against_mirror(bearing, coordinate)) then
          weight(:, pad%first_node + 1:pad%last_node) = -film%part_torque_weight
        else
          do k = 1, size(coordinate)
            associate (of_motion => weight(k, pad%first_node + 1:pad%last_node), j => moved(k))
              of_motion = acts_on(j)*film%force_weight(j, :)
              if (pad%whole%repeats > 1 .and. j > all_translations) of_motion = acts_on(j)*film%part_torque_weight(j - all_translations, :)
            end associate
          end do
        end if
      end associate
    end do
  end function motion_weights

  !> 1 where such a motion has a local unknown of the bearing, else 0; the shaft's it never has.
  pure function motion_unknowns(bearing, coordinate, foils_move) result(has)
    type(bearing_system_type), intent(in) :: bearing !! that vibrates
    integer, intent(in) :: coordinate(:) !! of the shaft that move
    logical, intent(in) :: foils_move    !! or stay where they are
    real(wp) :: has(bearing%local_size())
    integer :: i

    has = 1.0_wp
    has(bearing%first_shaft + 1:) = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), film => bearing%pad(i)%film, first => bearing%pad(i)%first)
        if (against_mirror(bearing, coordinate)) then
          where (abs(film%axial) <= epsilon(1.0_wp)*film%width)
            has(first + 1:first + size(film%axial)) = 0.0_wp
          end where
        end if
        if (.not. foils_move) has(first + pad%foil%first + 1:pad%last) = 0.0_wp
      end associate
    end do
  end function motion_unknowns

  !> Whether motions on half the width are those against the other half's mirror.
  pure logical function against_mirror(bearing, coordinate) result(against)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: coordinate(:) !! of the shaft that move
    against = bearing%mesh%half .and. coordinate(1) == tilts(1)
  end function against_mirror

  !> Linearises a bearing about its present state, which must be an answer and is left as it is.
  subroutine create_response(bearing, vibration, response, opposite, log)
    type(bearing_system_type), intent(inout) :: bearing !! pads and shaft
    type(vibration_type), intent(in) :: vibration !! of the foil
    type(dynamic_response_type), intent(out) :: response !! to vibrations of the shaft
    !> the bearing of tilts, where foils on half the width move with them: without it tilts are not answered; it moves
    !> into the response
    type(bearing_system_type), allocatable, optional, intent(inout) :: opposite
    type(run_log_type), optional, intent(in) :: log !! where lines of progress go
    PetscErrorCode :: ierr

    if (present(log)) response%log = log
    if (present(opposite)) call move_alloc(opposite, response%opposite_bearing)
    call linearise_steady(bearing, vibration%stick, response%equations%steady, response%opposite_bearing)
    if (allocated(response%opposite_bearing)) then
      allocate (response%opposite)
      response%opposite%log = response%log
      call linearise_exactly(response%opposite_bearing, .true.)
      PetscCallA(MatDuplicate(response%opposite_bearing%jacobian, MAT_COPY_VALUES, response%opposite%equations%steady, ierr))
      call complete_response(response%opposite_bearing, vibration, response%opposite)
      call response%opposite_bearing%drop_matrices()
    end if
    call complete_response(bearing, vibration, response)
  end subroutine create_response

  !> Derivative of the steady equations, the shaft fixed, without artificial stiffness of open contacts.
  subroutine linearise_steady(bearing, stick, steady, opposite)
    type(bearing_system_type), intent(inout) :: bearing !! at its answer
    logical, intent(in) :: stick !! contacts that rub stick
    Mat, intent(out) :: steady !! like the bearing's own
    type(bearing_system_type), allocatable, optional, intent(inout) :: opposite !! gets the state, where there is one
    logical :: moved
    PetscErrorCode :: ierr
    integer :: i

    call bearing%settle(bearing%state, moved)
    do i = 1, size(bearing%pad)
      associate (foil => bearing%pad(i)%foil)
        if (stick .and. foil%has_contacts()) call stick_contacts(foil%contacts)
      end associate
    end do
    call linearise_exactly(bearing, .true.)
    PetscCallA(MatDuplicate(bearing%jacobian, MAT_COPY_VALUES, steady, ierr))
    if (present(opposite)) then
      if (allocated(opposite)) call lend_state(bearing, opposite)
    end if
    call bearing%settle(bearing%state, moved)
  end subroutine linearise_steady

  !> Gives the bearing of opposite motions the film and the mouths of an answer and the stiffness of its contacts; its own
  !> foil stays, for at z = 0 it could not follow.
  subroutine lend_state(bearing, opposite)
    type(bearing_system_type), intent(in) :: bearing
    type(bearing_system_type), intent(inout) :: opposite
    real(wp) :: given(bearing%local_size()), taken(opposite%local_size())
    integer :: i, k

    call bearing%get_unknowns(given)
    opposite%point = bearing%point
    taken = 0.0_wp
    call opposite%put_pressure(bearing%film_pressure(given), taken)
    if (allocated(bearing%feed)) then
      associate (mouths => mouth_unknowns*size(bearing%feed%mouth), to => opposite%feed%first, from => bearing%feed%first)
        taken(to + 1:to + mouths) = given(from + 1:from + mouths)
      end associate
    end if
    taken(opposite%first_shaft + 1:) = given(bearing%first_shaft + 1:)
    call opposite%set_unknowns(taken)
    do k = 1, size(bearing%pad)
      associate (pad => bearing%pad(k), other => opposite%pad(k))
        other%held = pad%foil%deflection(given(pad%first + 1:pad%last))
        do i = 1, size(pad%foil%contacts%point)
          other%foil%contacts%point(i)%derivative = pad%foil%contacts%point(i)%derivative
        end do
      end associate
    end do
  end subroutine lend_state

  !> Slope of the asperities' pressure at this rank's nodes.
  subroutine measure_asperities(bearing, rate)
    type(bearing_system_type), intent(in) :: bearing !! at its answer
    real(wp), allocatable, intent(out) :: rate(:) !! over the gap [Pa/m]
    real(wp) :: unknown(bearing%local_size())

    allocate (rate(bearing%film_nodes()), source=0.0_wp)
    if (.not. bearing%asperities%present) return
    call bearing%get_unknowns(unknown)
    rate = bearing%solid_rate(bearing%gap(unknown))
  end subroutine measure_asperities

  !> What else there is beside the steady equations.
  subroutine complete_response(bearing, vibration, response)
    type(bearing_system_type), intent(inout) :: bearing
    type(vibration_type), intent(in) :: vibration
    type(dynamic_response_type), intent(inout) :: response !! with its steady equations
    integer :: k
    PetscErrorCode :: ierr

    response%equations%vibration = vibration
    call add_vibrations(bearing, response%equations)
    PetscCallA(VecDuplicate(bearing%state, response%one, ierr))
    PetscCallA(VecDuplicate(bearing%state, response%other, ierr))
    response%motion = bearing%mesh%surface%motions()
    call create_vectors(bearing, size(response%motion), response%change)
    call create_vectors(bearing, size(response%motion), response%rise)
    do k = 1, size(response%motion)
      PetscCallA(VecDuplicate(bearing%state, response%steady_column(k), ierr))
      PetscCallA(VecDuplicate(bearing%state, response%squeeze_column(k), ierr))
      call bearing%shaft_column(response%motion(k), response%steady_column(k))
      call squeeze_column(bearing, response%motion(k), response%squeeze_column(k))
    end do
    call measure_asperities(bearing, response%solid_rate)
    call create_parts(bearing, response)
  end subroutine complete_response

  !> Room for complex vectors.
  subroutine create_vectors(bearing, motions, vectors)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: motions
    type(motion_vectors_type), intent(inout) :: vectors
    integer :: k
    PetscErrorCode :: ierr

    allocate (vectors%re(motions), vectors%im(motions))
    do k = 1, motions
      PetscCallA(VecDuplicate(bearing%state, vectors%re(k), ierr))
      PetscCallA(VecDuplicate(bearing%state, vectors%im(k), ierr))
    end do
  end subroutine create_vectors

  !> Frees them.
  subroutine destroy_vectors(vectors)
    type(motion_vectors_type), intent(inout) :: vectors
    integer :: k
    PetscErrorCode :: ierr

    do k = 1, size(vectors%re)
      PetscCallA(VecDestroy(vectors%re(k), ierr))
      PetscCallA(VecDestroy(vectors%im(k), ierr))
    end do
    deallocate (vectors%re, vectors%im)
  end subroutine destroy_vectors

  !> Motions of both symmetries on half the width, or all motions at once.
  subroutine create_parts(bearing, response)
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    integer :: i, parts

    parts = 1
    associate (pad => bearing%pad(1))
      if (pad%whole%half .and. .not. pad%whole%opposite .and. .not. pad%foil%moves_against_mirror()) parts = 2
    end associate
    allocate (response%part(parts))
    associate (part => response%part, whole => bearing%mesh, steady => response%equations%steady)
      if (whole%opposite) then
        call create_part(bearing, steady, tilts, .true., part(1))
      else if (.not. whole%half) then
        call create_part(bearing, steady, [(i, i=1, size(response%motion))], .true., part(1))
      else
        call create_part(bearing, steady, translations, .true., part(1))
      end if
      if (size(part) == 2) call create_part(bearing, steady, tilts, .false., part(2))
      do i = 1, size(part)
        call keep_columns(part(i), response)
      end do
    end associate
  end subroutine create_parts

  !> A part with its weights, and a complex matrix of the motions, still empty.
  subroutine create_part(bearing, steady, coordinate, foils_move, part)
    type(bearing_system_type), intent(in) :: bearing
    Mat, intent(in) :: steady !! whose pattern it takes
    integer, intent(in) :: coordinate(:) !! of the shaft that move
    logical, intent(in) :: foils_move    !! or stay where they are
    type(part_type), intent(inout) :: part
    Vec :: flags
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    part%coordinate = coordinate
    part%weight = motion_weights(bearing, coordinate)
    PetscCallA(VecDuplicate(bearing%state, flags, ierr))
    call bearing%exchange%put(motion_unknowns(bearing, coordinate, foils_move), flags)
    PetscCallA(GFB_VecGetArrayRead(flags, values, ierr))
    part%kept = values > 0.5_wp
    PetscCallA(GFB_VecRestoreArrayRead(flags, values, ierr))
    PetscCallA(VecDestroy(flags, ierr))
    call create_solver(bearing, steady, part%kept, part%solver)
  end subroutine create_part

  !> What solves a part's equations: iterations where those of the answer are solved so, else factors.
  subroutine create_solver(bearing, steady, kept, solver)
    type(bearing_system_type), intent(in) :: bearing
    Mat, intent(in) :: steady !! whose pattern it takes
    logical, intent(in) :: kept(:) !! owned unknowns
    class(complex_solver_type), allocatable, intent(out) :: solver !! without a matrix yet
    type(complex_factors_type), allocatable :: factors
    type(complex_iterations_type), allocatable :: iterations

    if (bearing%has_motions) then
      allocate (iterations)
      call create_complex_iterations(bearing%motions, kept, coupled_columns(bearing), iterations)
      call move_alloc(iterations, solver)
    else
      allocate (factors)
      call create_complex_factors(steady, kept, coupled_columns(bearing), factors)
      call move_alloc(factors, solver)
    end if
  end subroutine create_solver

  !> Columns, from the first, that rows may hold: not those of the shaft, which is moved from outside.
  pure integer function coupled_columns(bearing) result(columns)
    type(bearing_system_type), intent(in) :: bearing !! that vibrates
    columns = bearing%unknowns - bearing%blocks%border%scalars
  end function coupled_columns

  !> Takes out of the right sides of a part's motions what its equations do not have.
  subroutine keep_columns(part, response)
    type(part_type), intent(in) :: part
    type(dynamic_response_type), intent(in) :: response
    integer :: i

    do i = 1, size(part%coordinate)
      associate (k => part%coordinate(i))
        call keep_entries(response%steady_column(k), part%kept)
        call keep_entries(response%squeeze_column(k), part%kept)
      end associate
    end do
  end subroutine keep_columns

  !> Z of motions \( e^{\lambda t} \), one factorization for those of each symmetry.
  recursive subroutine find_coefficients(bearing, response, rate, coefficient, found, only_translations, keep)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    complex(wp), intent(in) :: rate !! lambda, i omega for vibrations; with a loss factor for these alone [1/s]
    complex(wp), intent(out) :: coefficient(:, :) !! (force, motion) in the order of the response's motions; 0 by symmetry [SI]
    logical, intent(out) :: found !! all of them; else a matrix cannot be factorized
    logical, intent(in), optional :: only_translations !! tilts are not asked for
    logical, intent(in), optional :: keep !! factors of all motions stay, for solutions to come; default: one set alone
    complex(wp) :: other(size(coefficient, 1), size(coefficient, 2))
    integer :: i, wanted
    logical :: keeps

    coefficient = 0.0_wp
    found = .false.
    wanted = size(response%motion)
    if (present(only_translations)) wanted = merge(size(translations), wanted, only_translations)
    if (allocated(response%opposite)) call release_parts(response%opposite)
    call combine(response%equations, rate)
    do i = 1, size(response%part)
      if (response%part(i)%coordinate(1) > wanted) cycle
      call prepare_part(response, i, found)
      if (found) call solve_part(bearing, response, rate, wanted, response%part(i), coefficient, found)
      if (.not. found) return
    end do
    if (bearing%mesh%repeats > 1) call add_turned_pads(bearing%mesh%repeats, coefficient)
    if (wanted < size(response%motion)) return
    if (.not. allocated(response%opposite)) then
      found = any([(response%part(i)%coordinate == wanted, i=1, size(response%part))])
      if (.not. found) error stop 'tilts on half the width are asked of a response without the bearing that they move'
      return
    end if
    keeps = .false.
    if (present(keep)) keeps = keep
    if (.not. keeps) call release_parts(response)
    associate (opposite => response%opposite)
      call find_coefficients(response%opposite_bearing, opposite, rate, other, found)
      coefficient(tilts, tilts) = other(tilts, tilts)
    end associate
    call take_over_counts(response)
  end subroutine find_coefficients

  !> Frees the matrix and the factors of all parts, so that those of the opposite motions do not stand beside them.
  subroutine release_parts(response)
    type(dynamic_response_type), intent(inout) :: response !! its determinants stay known
    integer :: i

    call release_sums(response%equations)
    do i = 1, size(response%part)
      call response%part(i)%solver%release()
    end do
  end subroutine release_parts

  !> What the opposite motions have cost counts as the response's own.
  subroutine take_over_counts(response)
    type(dynamic_response_type), intent(inout) :: response !! with an opposite one, which counts anew
    associate (opposite => response%opposite)
      response%factorizations = response%factorizations + opposite%factorizations
      response%enlargements = response%enlargements + opposite%enlargements
      response%status = opposite%status
      opposite%factorizations = 0
      opposite%enlargements = 0
    end associate
  end subroutine take_over_counts

  !> Z of a part's motions and its derivative by \( \lambda \), with one factorization.
  subroutine find_sample(bearing, response, number, rate, value, slope, found, without_mass)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    integer, intent(in) :: number !! of its part
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), intent(out) :: value(:, :) !! (force, motion) Z of the part's coordinates [SI]
    complex(wp), intent(out) :: slope(:, :) !! its derivative [SI]
    logical, intent(out) :: found !! else the matrix cannot be factorized
    logical, intent(in), optional :: without_mass !! the derivative lacks the foil's; default: it has it
    complex(wp), dimension(size(response%motion), size(response%motion)) :: z, dz

    z = 0.0_wp
    dz = 0.0_wp
    if (allocated(response%opposite)) call release_parts(response%opposite)
    call combine(response%equations, rate)
    call prepare_part(response, number, found)
    if (.not. found) return
    call combine_rate(response%equations, rate, without_mass)
    associate (part => response%part(number))
      call solve_part(bearing, response, rate, size(response%motion), part, z, found, dz)
      if (bearing%mesh%repeats > 1) then
        call add_turned_pads(bearing%mesh%repeats, z)
        call add_turned_pads(bearing%mesh%repeats, dz)
      end if
      value = z(part%coordinate, part%coordinate)
      slope = dz(part%coordinate, part%coordinate)
    end associate
  end subroutine find_sample

  !> Makes N times the coefficients of one pad those of N, each turned by a part of the circle: \( \sum_k T_k^T Z T_k \), with
  !> tilts turned by \( T_k \).
  pure subroutine add_turned_pads(pads, coefficient)
    integer, intent(in) :: pads !! N, equal ones
    complex(wp), intent(inout) :: coefficient(:, :) !! of e_z, phi_x, phi_y [SI]
    complex(wp) :: one(size(coefficient, 1), size(coefficient, 1))
    real(wp) :: turned(size(coefficient, 1), size(coefficient, 1)), angle
    integer :: k

    one = coefficient/pads
    coefficient = 0.0_wp
    turned = 0.0_wp
    turned(1, 1) = 1.0_wp
    do k = 0, pads - 1
      angle = turn*real(k, wp)/real(pads, wp)
      turned(2:, 2) = [cos(angle), -sin(angle)]
      turned(2:, 3) = [sin(angle), cos(angle)]
      coefficient = coefficient + matmul(transpose(turned), matmul(one, turned))
    end do
  end subroutine add_turned_pads

  !> Why the last coefficients were not found.
  function response_failure(response) result(words)
    type(dynamic_response_type), intent(in) :: response !! that was asked
    character(len=:), allocatable :: words

    words = response%part(1)%solver%failure(response%status)
  end function response_failure

  !> Gives the solver of a part the matrix that was combined last.
  subroutine prepare_part(response, number, made)
    type(dynamic_response_type), intent(inout) :: response !! its factorizations are counted
    integer, intent(in) :: number !! of its part
    logical, intent(out) :: made  !! else nothing can be solved

    response%factorizations = response%factorizations + 1
    call response%log%waiting('factorization '//text(response%factorizations)//' of vibrations')
    associate (equations => response%equations)
      call response%part(number)%solver%prepare(equations%real_part, equations%imaginary_part, response%status, &
                                                response%enlargements)
    end associate
    made = response%status >= 0
  end subroutine prepare_part

  !> Forces of a part's motions, of the matrix that its solver has.
  subroutine solve_part(bearing, response, rate, wanted, part, coefficient, found, slope)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(in) :: response !! of it; `change` and `rise` keep the answers
    complex(wp), intent(in) :: rate   !! lambda [1/s]
    integer, intent(in) :: wanted     !! coordinates, from the first
    type(part_type), intent(in) :: part !! of the response, factorized
    complex(wp), intent(inout) :: coefficient(:, :) !! (force, motion) [SI]
    logical, intent(out) :: found !! all were solved
    !> gets the derivatives by lambda, where that of the matrix was combined last [SI]
    complex(wp), intent(inout), optional :: slope(:, :)
    PetscErrorCode :: ierr
    integer, allocatable :: asked(:)
    integer :: i

    asked = pack(part%coordinate, part%coordinate <= wanted)
    do i = 1, size(asked)
      associate (k => asked(i), re => response%change%re(asked(i)), im => response%change%im(asked(i)))
        PetscCallA(VecWAXPY(re, real(rate, wp), response%squeeze_column(k), response%steady_column(k), ierr))
        PetscCallA(VecCopy(response%squeeze_column(k), im, ierr))
        PetscCallA(VecScale(im, aimag(rate), ierr))
      end associate
    end do
    call part%solver%solve(response%change%re(asked), response%change%im(asked), found)
    ! The answer is minus the change, as the force is.
    call take_forces(response%change, 1.0_wp, coefficient)
    if (.not. (found .and. present(slope))) return
    call solve_rise(response, part, asked, found)
    call take_forces(response%rise, 0.0_wp, slope)

  contains

    subroutine take_forces(answer, motion, force)
      type(motion_vectors_type), intent(in) :: answer
      real(wp), intent(in) :: motion !! of the shaft, with it [m], [rad]
      complex(wp), intent(inout) :: force(:, :) !! (force, motion) [SI]
      integer :: i

      do i = 1, size(asked)
        associate (k => asked(i))
          force(part%coordinate, k) = cmplx(forces_of(bearing, response, part, k, motion, answer%re(k)), &
                                            forces_of(bearing, response, part, k, 0.0_wp, answer%im(k)), wp)
        end associate
      end do
    end subroutine take_forces
  end subroutine solve_part

  !> How minus a change of the unknowns, y, rises with \( \lambda \): from \( A y = f_q + \lambda c_q \) follows
  !> \( A y' = c_q - A' y \).
  subroutine solve_rise(response, part, coordinate, solved)
    type(dynamic_response_type), intent(in) :: response !! with A' combined; y in `change`, y' goes into `rise`
    type(part_type), intent(in) :: part !! of the response, factorized
    integer, intent(in) :: coordinate(:) !! those that move
    logical, intent(out) :: solved !! for all of them
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, size(coordinate)
      associate (k => coordinate(i))
        associate (re => response%equations%real_part, im => response%equations%imaginary_part, product => response%one, &
                   change_re => response%change%re(k), change_im => response%change%im(k), rise_re => response%rise%re(k), &
                   rise_im => response%rise%im(k))
          PetscCallA(MatMult(re, change_re, rise_re, ierr))
          PetscCallA(MatMult(im, change_im, product, ierr))
          PetscCallA(VecAYPX(rise_re, -1.0_wp, response%squeeze_column(k), ierr))
          PetscCallA(VecAXPY(rise_re, 1.0_wp, product, ierr))
          PetscCallA(MatMult(re, change_im, rise_im, ierr))
          PetscCallA(MatMult(im, change_re, product, ierr))
          PetscCallA(VecAXPY(rise_im, 1.0_wp, product, ierr))
          PetscCallA(VecScale(rise_im, -1.0_wp, ierr))
          call keep_entries(rise_re, part%kept)
          call keep_entries(rise_im, part%kept)
        end associate
      end associate
    end do
    call part%solver%solve(response%rise%re(coordinate), response%rise%im(coordinate), solved)
  end subroutine solve_rise

  !> Weighted pressures of minus a change of the unknowns, with the asperities'.
  function forces_of(bearing, response, part, coordinate, motion, change) result(force)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(in) :: response !! of it
    type(part_type), intent(in) :: part !! of the response
    integer, intent(in) :: coordinate !! that moves
    real(wp), intent(in) :: motion    !! how far, with this change [m], [rad]
    Vec, intent(in) :: change         !! minus it, scaled
    real(wp) :: force(size(part%coordinate)), value(bearing%local_size()), pressure(bearing%film_nodes())
    integer :: i

    call bearing%get_unknowns(value, change)
    pressure = bearing%film_pressure(value)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), first => bearing%pad(i)%first_node + 1, last => bearing%pad(i)%last_node)
        if (.not. pad%contact%present) cycle
        call add_asperities(pad, response%solid_rate(first:last), response%motion(coordinate), motion, value(pad%first + 1:pad%last), &
                            pressure(first:last))
      end associate
    end do
    force = sum_over_ranks(matmul(part%weight, pressure))
  end function forces_of

  !> This rank's shares of the derivatives of `forces_of` by that change, in SI.
  pure function force_gradient(bearing, response, part) result(gradient)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(in) :: response !! of it
    type(part_type), intent(in) :: part !! of the response
    real(wp) :: gradient(bearing%local_size(), size(part%coordinate))
    integer :: i, node

    gradient = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), first => bearing%pad(i)%first_node)
        do node = 1, pad%last_node - first
          associate (weight => part%weight(:, first + node), mine => gradient(pad%first + node, :))
            mine = mine + weight
          end associate
          if (.not. pad%contact%present .or. pad%foil%source(node) == 0) cycle
          associate (weight => part%weight(:, first + node), mine => gradient(pad%first + pad%foil%source(node), :))
            mine = mine + pad%foil%rate(node)*response%solid_rate(first + node)*weight
          end associate
        end do
      end associate
    end do
  end function force_gradient

  !> Adds the pressures of a pad's asperities.
  pure subroutine add_asperities(pad, solid_rate, coordinate, motion, value, pressure)
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: solid_rate(:) !! slope of their pressure over the gap [Pa/m]
    integer, intent(in) :: coordinate !! of the shaft
    real(wp), intent(in) :: motion   !! [m], [rad]
    real(wp), intent(in) :: value(:) !! minus the change of the pad's unknowns, in SI
    real(wp), intent(inout) :: pressure(:) !! at the pad's nodes [Pa]
    real(wp) :: gap
    integer :: node

    do node = 1, size(pressure)
      gap = -motion*pad%film%motion(coordinate, node)
      if (pad%foil%source(node) > 0) gap = gap + pad%foil%rate(node)*value(pad%foil%source(node))
      pressure(node) = pressure(node) + solid_rate(node)*gap
    end do
  end subroutine add_asperities

  !> Frees what PETSc holds.
  recursive subroutine destroy_response(response)
    type(dynamic_response_type), intent(inout) :: response !! created before
    PetscErrorCode :: ierr
    integer :: i

    if (allocated(response%opposite)) then
      call destroy_response(response%opposite)
      call response%opposite_bearing%destroy()
      deallocate (response%opposite, response%opposite_bearing)
    end if
    do i = 1, size(response%part)
      call response%part(i)%solver%destroy()
    end do
    do i = 1, size(response%motion)
      PetscCallA(VecDestroy(response%steady_column(i), ierr))
      PetscCallA(VecDestroy(response%squeeze_column(i), ierr))
    end do
    PetscCallA(VecDestroy(response%one, ierr))
    PetscCallA(VecDestroy(response%other, ierr))
    call destroy_vectors(response%change)
    call destroy_vectors(response%rise)
    call destroy_equations(response%equations)
  end subroutine destroy_response
end module gfb_dynamic_response
