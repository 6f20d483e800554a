!> Coulomb friction at the contacts of an elastic body, under a load that grows in proportion.
!>
!> Elastic forces are linear in the contacts' displacements u; so is each normal force:
!>
!> $$ K u = q + f, \quad
!>    N = N_0 + G u, \quad
!>    |f_i| \le \mu_i \sum_k \max(N_k, 0), \quad
!>    f_i = -\mu_i \sum_k \max(N_k, 0) \ \mathrm{sign}\, u_i \ \text{where} \ u_i \ne 0 $$
!>
!> with the sum over the normal forces k that contact i owns. All is homogeneous of first order, so
!> a load that grows from zero in proportion keeps each contact sticking at its start or slipping
!> in one direction: the end state needs no steps.
module gfb_coulomb_contacts
  use gfb_kinds, only: wp
  use gfb_linear_solve, only: solve_general
  implicit none (type, external)
  private
  public :: coulomb_contacts_type, solve_contacts

  integer, parameter :: largest_sweeps = 100000 !! mostly some thousand do
  integer, parameter :: newton_tries = 30       !! if not by then, it cycles
  integer, parameter :: sweeps_a_try = 10       !! a direct solve costs about so many sweeps
  real(wp), parameter :: slack = 1.0e-11_wp     !! round-off of the direct solve, relative

  !> The contacts and what is behind them, n contacts with m normal forces.
  type :: coulomb_contacts_type
    real(wp), allocatable :: stiffness(:, :)        !! K (n, n) [N/m]
    real(wp), allocatable :: load(:)                !! q (n) [N]
    real(wp), allocatable :: friction(:)            !! mu (n) [1]
    real(wp), allocatable :: normal_load(:)         !! N_0 (m) [N]
    real(wp), allocatable :: normal_stiffness(:, :) !! G (m, n) [N/m]
    integer, allocatable :: owner(:)                !! (m), contact; 0: nobody's
    logical :: floating = .false. !! all contacts can move together without any force
  end type coulomb_contacts_type

contains

  !> Finds displacements that satisfy all laws to round-off.
  !>
  !> Sweeps with the exact answer of one contact at a time guess which contacts stick and slip; a
  !> direct solve with these states is the answer if it agrees with all of them. First one sweep
  !> from each direct solve (Newton's method, which often converges in ten solves, but can cycle),
  !> then sweeps alone (Gauss-Seidel, slow and sure). Where friction leaves a floating body's
  !> position open, because all contacts slip, their displacements' sum is zero.
  pure subroutine solve_contacts(contacts, displacement, converged)
    type(coulomb_contacts_type), intent(in) :: contacts !! stiffness, forces and friction of all
    real(wp), intent(out) :: displacement(:) !! u (n), exactly 0 where a contact sticks [m]
    logical, intent(out) :: converged        !! all laws are satisfied

    real(wp) :: swept(size(displacement))
    integer :: slip(size(displacement)), tried(size(displacement)), sweep
    logical :: pressed(size(contacts%owner)), tried_pressed(size(contacts%owner))

    swept = 0.0_wp
    tried = huge(1)
    tried_pressed = .false.
    converged = .false.
    do sweep = 1, largest_sweeps
      call sweep_contacts(contacts, swept)
      if (sweep > newton_tries .and. modulo(sweep, sweeps_a_try) /= 0) cycle
      slip = direction(swept)
      pressed = normal_forces(contacts, swept) > 0.0_wp
      if (all(slip == tried) .and. all(pressed .eqv. tried_pressed)) cycle
      tried = slip
      tried_pressed = pressed
      call solve_states(contacts, slip, pressed, displacement, converged)
      if (converged) exit
      if (sweep < newton_tries) swept = displacement
      if (sweep == newton_tries) swept = 0.0_wp
    end do
    if (.not. converged) displacement = swept
    if (converged .and. contacts%floating) call centre(contacts, pressed, displacement)
  end subroutine solve_contacts

  !> Moves a floating body to its middle position where friction leaves that open: where each
  !> contact that sticks is about to slip, all may slip.
  pure subroutine centre(contacts, pressed, displacement)
    type(coulomb_contacts_type), intent(in) :: contacts
    logical, intent(in) :: pressed(:)          !! (m), the normal force is positive
    real(wp), intent(inout) :: displacement(:) !! u (n), one answer [m]
    real(wp) :: centred(size(displacement)), force(size(displacement))
    logical :: fits

    force = matmul(contacts%stiffness, displacement) - contacts%load
    call solve_states(contacts, direction(-force), pressed, centred, fits)
    if (fits) displacement = centred
  end subroutine centre

  !> Friction each contact can bear, \( \mu_i \sum_k \max(N_k, 0) \) [N].
  pure function friction_limits(contacts, displacement) result(limits)
    type(coulomb_contacts_type), intent(in) :: contacts !! stiffness, forces and friction of all
    real(wp), intent(in) :: displacement(:) !! u (n) [m]
    real(wp) :: limits(size(displacement))
    real(wp) :: normal(size(contacts%owner))
    integer :: k

    normal = normal_forces(contacts, displacement)
    limits = 0.0_wp
    do k = 1, size(normal)
      associate (i => contacts%owner(k))
        if (i > 0) limits(i) = limits(i) + contacts%friction(i)*max(normal(k), 0.0_wp)
      end associate
    end do
  end function friction_limits

  !> Normal forces [N].
  pure function normal_forces(contacts, displacement) result(normal)
    type(coulomb_contacts_type), intent(in) :: contacts
    real(wp), intent(in) :: displacement(:) !! u (n) [m]
    real(wp) :: normal(size(contacts%owner))
    normal = contacts%normal_load + matmul(contacts%normal_stiffness, displacement)
  end function normal_forces

  !> -1, 0 or 1: in which direction each contact has slipped.
  elemental function direction(displacement) result(slip)
    real(wp), intent(in) :: displacement !! [m]
    integer :: slip
    slip = 0
    if (displacement > 0.0_wp) slip = 1
    if (displacement < 0.0_wp) slip = -1
  end function direction

  !> One sweep: each contact answers its own law while the others and the normal forces rest.
  pure subroutine sweep_contacts(contacts, displacement)
    type(coulomb_contacts_type), intent(in) :: contacts
    real(wp), intent(inout) :: displacement(:) !! u (n) [m]
    real(wp) :: limits(size(displacement)), force
    integer :: i

    limits = friction_limits(contacts, displacement)
    do i = 1, size(displacement)
      associate (own => contacts%stiffness(i, i))
        force = contacts%load(i) + own*displacement(i) &
          - dot_product(contacts%stiffness(:, i), displacement)
        displacement(i) = sign(max(abs(force) - limits(i), 0.0_wp), force)/own
      end associate
    end do
  end subroutine sweep_contacts

  !> Displacements that fit with given states, and whether these states fit with them.
  pure subroutine solve_states(contacts, slip, pressed, displacement, fits)
    type(coulomb_contacts_type), intent(in) :: contacts
    integer, intent(in) :: slip(:)           !! (n), -1, 0 (sticks) or 1
    logical, intent(in) :: pressed(:)        !! (m), the normal force is positive
    real(wp), intent(out) :: displacement(:) !! u (n) [m]
    logical, intent(out) :: fits

    real(wp), allocatable :: matrix(:, :), right_side(:)
    real(wp) :: limits(size(slip)), force(size(slip)), tolerance
    integer, allocatable :: moving(:)
    integer :: n, i

    moving = pack([(i, i=1, size(slip))], slip /= 0)
    n = size(moving)
    call slip_equations(contacts, slip, pressed, moving, matrix, right_side)
    call solve_general(matrix, right_side, fits)
    displacement = 0.0_wp
    if (.not. fits) return
    displacement(moving) = right_side(:n)
    limits = friction_limits(contacts, displacement)
    force = matmul(contacts%stiffness, displacement) - contacts%load
    tolerance = slack*max(maxval(abs(contacts%load)), maxval(limits))
    fits = all(direction(displacement) == slip) .and. all(abs(force) <= limits + tolerance) .and. &
      all(slip == 0 .or. abs(force + slip*limits) <= tolerance) .and. &
      all((normal_forces(contacts, displacement) > 0.0_wp) .eqv. pressed)
  end subroutine solve_states

  !> Equations of the contacts that slip. A body that floats with all its contacts slipping gets one
  !> unknown more, an even force on all of them that is zero in the answer, and one equation: the
  !> displacements' sum.
  pure subroutine slip_equations(contacts, slip, pressed, moving, matrix, right_side)
    type(coulomb_contacts_type), intent(in) :: contacts
    integer, intent(in) :: slip(:)    !! (n), -1, 0 (sticks) or 1
    logical, intent(in) :: pressed(:) !! (m), the normal force is positive
    integer, intent(in) :: moving(:)  !! contacts that slip
    real(wp), allocatable, intent(out) :: matrix(:, :)  !! one row and column a slipping contact
    real(wp), allocatable, intent(out) :: right_side(:)
    real(wp), allocatable :: rows(:, :), loads(:)
    real(wp) :: stiffest
    integer :: n, extra, i, k

    rows = contacts%stiffness
    loads = contacts%load
    do k = 1, size(contacts%owner)
      i = contacts%owner(k)
      if (i == 0 .or. .not. pressed(k)) cycle
      rows(i, :) = rows(i, :) + slip(i)*contacts%friction(i)*contacts%normal_stiffness(k, :)
      loads(i) = loads(i) - slip(i)*contacts%friction(i)*contacts%normal_load(k)
    end do
    n = size(moving)
    extra = 0
    if (contacts%floating .and. n == size(slip)) extra = 1
    allocate (matrix(n + extra, n + extra), right_side(n + extra), source=0.0_wp)
    matrix(:n, :n) = rows(moving, moving)
    right_side(:n) = loads(moving)
    if (extra == 0) return
    stiffest = maxval(abs(contacts%stiffness))
    matrix(:n, n + 1) = stiffest
    matrix(n + 1, :n) = stiffest
  end subroutine slip_equations
end module gfb_coulomb_contacts
