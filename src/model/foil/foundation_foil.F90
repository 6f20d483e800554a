#include "gfb_petsc.h"
!> An elastic foundation: the bumps as a bed of linear springs, [Heshmat1983].
!>
!> With local pressure each film node sinks by \( (p - p_a)/K \): no unknowns of its own. With the
!> axial mean every station sinks as a whole, by an unknown of its own:
!> \( K q = \frac{1}{L} \int (p - p_a) \, dz \). In sectors of a ring the mean is that along the radius,
!> weighted with it, and \( K = K_m (r/r_m)^n \) may change along it, \( r_m \) the mean radius.
module gfb_foundation_foil
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: this_rank, rank_count
  use gfb_scene, only: scene_type
  use gfb_foil_cases, only: bump_foil_case_type
  use gfb_model_case, only: model_case_type, foundation_pressure_axial_mean
  use gfb_curved_bump, only: walowit_anno_stiffness
  use gfb_foil_model, only: foil_model_type
  use gfb_film_mesh, only: film_mesh_type, row_weights
  use gfb_mesh_dm, only: local_mesh_type
  implicit none (type)
  private
  public :: build_foundation, foundation_stiffness

  integer, parameter :: bumps = 2 !! of the moduli

  !> The elastic foundation under the film.
  type, extends(foil_model_type), public :: foundation_foil_type
    real(wp) :: stiffness = 0.0_wp           !! K of the stations with the modulus that is typed, pressure over deflection [N/m3]
    real(wp), allocatable :: spring(:)       !! the same under each of this rank's nodes, under local pressure [N/m3]
    real(wp) :: ambient_pressure = 0.0_wp    !! p_a [Pa]
    real(wp) :: drag = 0.0_wp                !! of the dampers in a step of time [N/m3]
    real(wp), allocatable :: past_drag(:)    !! what earlier deflections of the owned stations add [Pa]
    integer, allocatable :: owned_station(:) !! foil unknowns whose equation this rank begins
    integer :: stations = 0                  !! of the whole film
    integer, allocatable :: averaged(:)      !! film nodes this rank averages
    real(wp), allocatable :: share(:)        !! of each of them in its station's mean [1]
  contains
    procedure :: add_residual => foundation_residual
    procedure :: add_jacobian => foundation_jacobian
    procedure :: add_load_rates => foundation_load_rates
    procedure :: add_springs => foundation_springs
    procedure :: soften => soften_foundation
    procedure :: add_modulus_rates => foundation_modulus_rates
    procedure :: deflection => foundation_deflection
    procedure :: put_damping => foundation_damping
    procedure :: estimate => foundation_estimate
    procedure :: natural_numbers => foundation_natural_numbers
  end type foundation_foil_type

contains

  !> The foundation that a scene asks for.
  subroutine build_foundation(scene, film, mesh, foil)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    type(local_mesh_type), intent(in) :: mesh !! this rank's part of it
    type(foundation_foil_type), intent(out) :: foil !! ready for the bearing
    real(wp) :: stiffness
    real(wp), allocatable :: part(:)
    integer :: i

    stiffness = foundation_stiffness(scene%model, scene%bump_foil)
    part = change_along(scene%model%foundation_exponent, film)
    if (scene%model%has_strips()) then ! the strip outside each row; elements have their own
      part = scene%model%strip_stiffness([(1 + count(scene%model%cut_radii <= film%row_axial(i)), i=1, film%rows())])/stiffness
    end if
    if (scene%model%foundation_pressure == foundation_pressure_axial_mean) then
      if (abs(scene%model%foundation_exponent) > 0.0_wp) stiffness = stiffness*dot_product(mean_weights(film), part)
      call create_mean_foundation(film, mesh, this_rank(), rank_count(), stiffness, scene%gas%ambient_pressure, &
                                  scene%bearing%clearance, foil)
    else
      call create_local_foundation(stiffness*part(modulo(mesh%mesh_node - 1, film%rows()) + 1), scene%gas%ambient_pressure, foil)
    end if
  end subroutine build_foundation

  !> Stiffness of the rows over that at the mean radius [1].
  pure function change_along(exponent, film) result(part)
    real(wp), intent(in) :: exponent !! of the radius [1]
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    real(wp) :: part(film%rows())

    part = 1.0_wp
    if (.not. abs(exponent) > 0.0_wp) return
    associate (radius => film%surface%radius_at(film%row_axial))
      part = (radius/(0.5_wp*(radius(1) + radius(size(radius)))))**exponent
    end associate
  end function change_along

  !> Weights of the rows in the mean across the motion [1].
  pure function mean_weights(film) result(weight)
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    real(wp) :: weight(film%rows())

    weight = row_weights(film)*film%surface%stretch(film%row_axial)
    weight = weight/sum(weight)
  end function mean_weights

  !> Stiffness of the foundation, as given, of strips their mean, or by Walowit and Anno [N/m3].
  pure real(wp) function foundation_stiffness(model, bump_foil) result(stiffness)
    type(model_case_type), intent(in) :: model !! gives the stiffness, or leaves it to the formula
    type(bump_foil_case_type), intent(in) :: bump_foil !! shape and material of the bumps

    stiffness = model%foundation_stiffness
    if (model%has_strips()) stiffness = sum(model%strip_stiffness)/real(size(model%strip_stiffness), wp)
    if (stiffness > 0.0_wp) return
    stiffness = walowit_anno_stiffness(bump_foil%youngs_modulus, bump_foil%poissons_ratio, &
                                       bump_foil%thickness%value, bump_foil%half_length%value, bump_foil%pitch%value)
  end function foundation_stiffness

  !> An elastic foundation that feels the local pressure.
  subroutine create_local_foundation(stiffness, ambient_pressure, foil)
    real(wp), intent(in) :: stiffness(:)        !! K at the film nodes of this rank [N/m3]
    real(wp), intent(in) :: ambient_pressure    !! p_a [Pa]
    type(foundation_foil_type), intent(out) :: foil !! without unknowns of its own
    integer :: i

    foil%spring = stiffness
    foil%ambient_pressure = ambient_pressure
    allocate (foil%global_unknown(0), foil%unknown_scale(0), foil%equation_scale(0))
    allocate (foil%owned_station(0), foil%averaged(0), foil%share(0), foil%row_entries(0))
    foil%source = [(i, i=1, size(stiffness))]
    foil%rate = 1.0_wp/stiffness
    allocate (foil%origin(size(stiffness)), source=ambient_pressure)
  end subroutine create_local_foundation

  !> An elastic foundation that feels the mean pressure along the axis.
  subroutine create_mean_foundation(film, mesh, rank, ranks, stiffness, ambient_pressure, &
                                    clearance, foil)
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    type(local_mesh_type), intent(in) :: mesh   !! this rank's part of it
    integer, intent(in) :: rank, ranks          !! this one, from 0, and their number
    real(wp), intent(in) :: stiffness           !! K [N/m3]
    real(wp), intent(in) :: ambient_pressure    !! p_a [Pa]
    real(wp), intent(in) :: clearance           !! C, the size of a deflection [m]
    type(foundation_foil_type), intent(out) :: foil !! with an unknown a station

    integer, allocatable :: local_of(:)
    real(wp), allocatable :: weight(:)
    integer :: first, last, i, row

    foil%stiffness = stiffness
    foil%ambient_pressure = ambient_pressure
    foil%couplings = 2*film%order + 1 ! its own station and those of the elements beside it
    foil%stations = film%stations()
    first = rank*film%stations()/ranks + 1
    last = (rank + 1)*film%stations()/ranks
    foil%owned = last - first + 1
    allocate (foil%row_entries(foil%owned), source=film%rows() + 1)

    allocate (local_of(film%stations()), source=0)
    local_of(first:last) = 1
    do i = 1, size(mesh%mesh_node)
      local_of((mesh%mesh_node(i) - 1)/film%rows() + 1) = 1
    end do
    foil%global_unknown = pack([(i, i=1, film%stations())], local_of == 1)
    do i = 1, size(foil%global_unknown)
      local_of(foil%global_unknown(i)) = i
    end do
    allocate (foil%unknown_scale(size(foil%global_unknown)), source=clearance)
    allocate (foil%equation_scale(size(foil%global_unknown)), source=stiffness*clearance)
    foil%owned_station = local_of(first:last)

    foil%source = [(-local_of((mesh%mesh_node(i) - 1)/film%rows() + 1), i=1, size(mesh%mesh_node))]
    allocate (foil%rate(size(foil%source)), source=1.0_wp)
    allocate (foil%origin(size(foil%source)), source=0.0_wp)
    foil%averaged = pack([(i, i=1, size(mesh%owned))], mesh%owned)
    allocate (foil%share(size(foil%averaged)))
    weight = mean_weights(film)
    do i = 1, size(foil%averaged)
      row = modulo(mesh%mesh_node(foil%averaged(i)) - 1, film%rows()) + 1
      foil%share(i) = weight(row)
    end do
  end subroutine create_mean_foundation

  !> Equations of the stations: spring pressure less mean overpressure [Pa].
  subroutine foundation_residual(self, unknown, residual)
    class(foundation_foil_type), intent(in) :: self !! the elastic foundation
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    real(wp), intent(inout) :: residual(:) !! of the bearing, one a local unknown [SI]
    integer :: i, node, equation

    do i = 1, size(self%owned_station)
      equation = self%first + self%owned_station(i)
      residual(equation) = residual(equation) + (self%modulus(bumps)*self%stiffness + self%drag)*unknown(equation)
      if (allocated(self%past_drag)) residual(equation) = residual(equation) + self%past_drag(i)
    end do
    do i = 1, size(self%averaged)
      node = self%averaged(i)
      equation = self%source(node)
      residual(equation) = residual(equation) &
        - self%share(i)*(unknown(node) - self%ambient_pressure)
    end do
  end subroutine foundation_residual

  !> Derivatives of the stations' equations.
  subroutine foundation_jacobian(self, unknown, jacobian)
    class(foundation_foil_type), intent(in) :: self !! the elastic foundation
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    Mat, intent(in) :: jacobian !! of the bearing, by local numbers
    PetscErrorCode :: ierr
    PetscInt :: row(1), column(1)
    integer :: i

    call self%add_springs(jacobian)
    do i = 1, size(self%averaged)
      row = int(self%source(self%averaged(i)) - 1, pint)
      column = int(self%averaged(i) - 1, pint)
      PetscCallA(MatSetValuesLocal(jacobian, 1_pint, row, 1_pint, column, [-self%share(i)], ADD_VALUES, ierr))
    end do
  end subroutine foundation_jacobian

  !> Adds the stations' springs; under local pressure there are no unknowns for them.
  subroutine foundation_springs(self, matrix)
    class(foundation_foil_type), intent(in) :: self !! the elastic foundation
    Mat, intent(in) :: matrix !! of the bearing, by local numbers
    PetscErrorCode :: ierr
    PetscInt :: row(1)
    integer :: i

    do i = 1, size(self%owned_station)
      row = int(self%first + self%owned_station(i) - 1, pint)
      PetscCallA(MatSetValuesLocal(matrix, 1_pint, row, 1_pint, row, [self%modulus(bumps)*self%stiffness + self%drag], ADD_VALUES, ierr))
    end do
  end subroutine foundation_springs

  !> Springs with dampers beside each: \( (K + drag) h_f + pull = p - p_a \).
  subroutine foundation_damping(self, drag, pull)
    class(foundation_foil_type), intent(inout) :: self !! the elastic foundation
    real(wp), intent(in) :: drag !! [N/m3]
    real(wp), intent(in) :: pull(:) !! what earlier deflections add, at the local unknown that moves a spring [Pa]

    self%drag = drag
    if (size(self%global_unknown) > 0) then
      self%past_drag = pull(self%first + self%owned_station)
    else
      self%rate = 1.0_wp/(self%modulus(bumps)*self%spring + self%drag)
      self%origin = self%ambient_pressure + pull(self%source)
    end if
  end subroutine foundation_damping

  !> Springs follow the modulus of the bumps.
  subroutine soften_foundation(self, modulus)
    class(foundation_foil_type), intent(inout) :: self !! the elastic foundation
    real(wp), intent(in) :: modulus(2) !! of top foil and bumps, over those it was built with [1]

    self%modulus = modulus
    if (size(self%global_unknown) == 0) self%rate = 1.0_wp/(modulus(bumps)*self%spring + self%drag)
  end subroutine soften_foundation

  !> Derivatives of the stations' equations by the modulus of the bumps.
  subroutine foundation_modulus_rates(self, unknown, rate)
    class(foundation_foil_type), intent(in) :: self !! the elastic foundation
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    real(wp), intent(inout) :: rate(:, :) !! (local unknowns of the bearing, 2) [SI]

    associate (equation => self%first + self%owned_station)
      rate(equation, bumps) = rate(equation, bumps) + self%stiffness*unknown(equation)
    end associate
  end subroutine foundation_modulus_rates

  !> Under local pressure deflections follow from springs that have no unknowns, whose modulus may be another one.
  pure function foundation_deflection(self, unknown, modulus) result(moved)
    class(foundation_foil_type), intent(in) :: self !! the elastic foundation
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    real(wp), intent(in), optional :: modulus(2) !! default: those that it has, see `soften`
    real(wp) :: moved(size(self%source))

    moved = self%foil_model_type%deflection(unknown)
    if (.not. present(modulus) .or. size(self%global_unknown) > 0) return
    moved = moved*((self%modulus(bumps)*self%spring + self%drag)/(modulus(bumps)*self%spring + self%drag))
  end function foundation_deflection

  !> The mean of a pressure that depends on other unknowns.
  subroutine foundation_load_rates(self, column, slope, jacobian)
    class(foundation_foil_type), intent(in) :: self !! the elastic foundation
    integer, intent(in) :: column(:, :) !! (3 or 5, film nodes) local numbers from 0; negative: none
    real(wp), intent(in) :: slope(:, :) !! (3 or 5, film nodes) of the pressure by these unknowns [SI]
    Mat, intent(in) :: jacobian !! of the bearing, by local numbers
    PetscErrorCode :: ierr
    PetscInt :: row(1), unknown(size(column, 1))
    integer :: i

    do i = 1, size(self%averaged)
      row = int(self%source(self%averaged(i)) - 1, pint)
      unknown = int(column(:, self%averaged(i)), pint)
      PetscCallA(MatSetValuesLocal(jacobian, 1_pint, row, int(size(unknown), pint), unknown, [-self%share(i)*slope(:, self%averaged(i))], ADD_VALUES, ierr))
    end do
  end subroutine foundation_load_rates

  !> Deflection of the stations under the pressures as they are.
  subroutine foundation_estimate(self, unknown)
    class(foundation_foil_type), intent(in) :: self !! the elastic foundation
    real(wp), intent(inout) :: unknown(:) !! local unknowns of the bearing [SI]
    real(wp) :: mean(self%stations), total(self%stations)
    integer :: i, node, station
    PetscErrorCode :: ierr

    if (size(self%global_unknown) == 0) return
    mean = 0.0_wp
    do i = 1, size(self%averaged)
      node = self%averaged(i)
      station = self%global_unknown(self%source(node) - self%first)
      mean(station) = mean(station) + self%share(i)*(unknown(node) - self%ambient_pressure)
    end do
    call MPI_Allreduce(mean, total, self%stations, MPI_DOUBLE_PRECISION, MPI_SUM, PETSC_COMM_WORLD, ierr)
    do i = 1, size(self%global_unknown)
      unknown(self%first + i) = total(self%global_unknown(i))/(self%modulus(bumps)*self%stiffness)
    end do
  end subroutine foundation_estimate

  !> The numbers of the stations whose equations this rank begins; none under local pressure.
  function foundation_natural_numbers(self) result(number)
    class(foundation_foil_type), intent(in) :: self !! the elastic foundation
    integer, allocatable :: number(:)
    number = self%global_unknown(self%owned_station)
  end function foundation_natural_numbers
end module gfb_foundation_foil
