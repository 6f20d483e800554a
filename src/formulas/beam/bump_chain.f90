!> A planar chain of bumps that push each other through their feet.
!>
!> In the manner of [LeLez2007]: three displacements a bump (crest along x, crest along v, foot
!> towards the next bump along x) and Coulomb friction at feet and crests. Derived anew: half arcs
!> are exact circular beams, flats are beams that bend between two corners fixed to the sleeve, and
!> the turns of corners and crests are eliminated. All per metre of width; x runs from bump 1 to the
!> last, v away from the sleeve.
!>
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
module gfb_bump_chain
  use gfb_kinds, only: wp
  use gfb_linear_solve, only: solve_positive, solve_general
  use gfb_curved_bump, only: bump_radius, bump_half_angle, bending_stiffness
  use gfb_arch_beam, only: section_type, left_arch_stiffness, right_arch_stiffness, flat_stiffness
  implicit none (type, external)
  private
  public :: bump_chain_type, bump_chain_solution_type, solve_bump_chain

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

  integer, parameter, public :: slips_back = -1   !! slipped towards smaller x
  integer, parameter, public :: sticks = 0        !! where it was
  integer, parameter, public :: slips_forward = 1 !! slipped towards larger x
  integer, parameter, public :: glides = 2        !! has no friction
  integer, parameter, public :: is_clamped = 3    !! part of the fixed line

  integer, parameter :: stride = 8 !! displacements from a foot to the next, see `freedoms_type`

  !> What a chain is made of.
  type :: bump_chain_type
    real(wp) :: half_length = 0.0_wp     !! l, half the chord of an arc [m]
    real(wp) :: height = 0.0_wp          !! h_b, of an arc [m]
    real(wp) :: thickness = 0.0_wp       !! t, of the foil [m]
    real(wp) :: youngs_modulus = 0.0_wp  !! E [Pa]
    real(wp) :: poissons_ratio = 0.0_wp  !! nu [1]
    real(wp) :: pitch = 0.0_wp           !! from crest to crest, at least 2 l [m]
    real(wp) :: width = 0.0_wp           !! b, along the axis [m]
    integer :: bumps = 0                 !! N
    logical :: clamped_start = .true.    !! first corner is clamped; else free as the last
    real(wp) :: friction_top = 0.0_wp    !! mu, of crests on an immobile plate [1]
    real(wp) :: friction_sleeve = 0.0_wp !! mu, of corners on the sleeve [1]
    logical :: inextensible = .false.    !! neither stretch nor shear
  end type bump_chain_type

  !> How a chain answers. Foot n lies between the bumps n and n + 1; a foot's flat does not stretch.
  type :: bump_chain_solution_type
    real(wp), allocatable :: crest_deflection(:)   !! (N), towards the sleeve [m]
    real(wp), allocatable :: crest_slip(:)         !! (N), along x [m]
    real(wp), allocatable :: foot_slip(:)          !! (0:N), along x [m]
    real(wp), allocatable :: crest_friction(:)     !! (N), of the plate, along x [N]
    real(wp), allocatable :: foot_friction(:)      !! (0:N), of sleeve or clamp, along x [N]
    real(wp), allocatable :: corner_reaction(:, :) !! (2, N), left, right, along v [N]
    integer, allocatable :: crest_state(:)         !! (N)
    integer, allocatable :: foot_state(:)          !! (0:N)
    logical :: lifted = .false.    !! a corner that is not clamped is pulled down, not pressed
    logical :: converged = .false. !! all laws are satisfied; else the last attempt
  end type bump_chain_solution_type

  !> Numbers of the displacements of the whole chain.
  type :: freedoms_type
    integer, allocatable :: foot(:)    !! (0:N)
    integer, allocatable :: rise(:, :) !! (2, N), v of the corners, fixed
    integer, allocatable :: turn(:, :) !! (2, N), of the corners; shared where there is no flat
    integer, allocatable :: crest(:)   !! (N), x; v and turn follow
    integer :: total = 0               !! how many
  end type freedoms_type

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
    real(wp) :: limits(size(displacement)), normal(size(contacts%owner))
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
  elemental integer function direction(displacement) result(slip)
    real(wp), intent(in) :: displacement !! [m]
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

  !> Presses on the crests of a chain.
  pure subroutine solve_bump_chain(chain, crest_force, solution)
    type(bump_chain_type), intent(in) :: chain !! bumps, forces and friction
    real(wp), intent(in) :: crest_force(:) !! (N), towards the sleeve, grown in proportion [N]
    type(bump_chain_solution_type), intent(out) :: solution !! displacements and contact forces

    type(freedoms_type) :: freedoms
    type(coulomb_contacts_type) :: contacts
    real(wp), allocatable :: stiffness(:, :), load(:), response(:, :), slip(:), displacement(:)
    integer, allocatable :: rubbing(:), inner(:)

    freedoms = place_freedoms(chain)
    stiffness = chain_stiffness(chain, freedoms)
    allocate (load(freedoms%total), displacement(freedoms%total), source=0.0_wp)
    load(freedoms%crest + 1) = -crest_force/chain%width
    call sort_freedoms(chain, freedoms, rubbing, inner)
    call eliminate(stiffness, load, rubbing, inner, response)
    contacts = condensed_contacts(chain, freedoms, stiffness, load, rubbing, inner, response)

    allocate (slip(size(rubbing)))
    solution%converged = .true.
    if (size(rubbing) > 0) call solve_contacts(contacts, slip, solution%converged)
    displacement(rubbing) = slip
    displacement(inner) = response(:, 1) - matmul(response(:, 2:), slip)
    call read_answer(chain, freedoms, stiffness, displacement, solution)
  end subroutine solve_bump_chain

  !> Numbers the displacements along x, so that what belongs together stands together.
  pure function place_freedoms(chain) result(freedoms)
    type(bump_chain_type), intent(in) :: chain
    type(freedoms_type) :: freedoms
    integer :: i

    allocate (freedoms%foot(0:chain%bumps), freedoms%crest(chain%bumps))
    allocate (freedoms%rise(2, chain%bumps), freedoms%turn(2, chain%bumps))
    do i = 1, chain%bumps
      associate (first => stride*(i - 1))
        freedoms%foot(i - 1) = first + 1
        freedoms%turn(:, i) = first + [2, 8]
        freedoms%rise(:, i) = first + [3, 7]
        freedoms%crest(i) = first + 4
      end associate
      if (i == 1 .or. flat_length(chain) > 0.0_wp) cycle
      freedoms%turn(1, i) = freedoms%turn(2, i - 1)
    end do
    freedoms%foot(chain%bumps) = stride*chain%bumps + 1
    freedoms%total = stride*chain%bumps + 1
  end function place_freedoms

  !> Length of a flat between two bumps [m].
  pure real(wp) function flat_length(chain) result(length)
    type(bump_chain_type), intent(in) :: chain
    length = chain%pitch - 2.0_wp*chain%half_length
    if (length < 16.0_wp*epsilon(1.0_wp)*chain%pitch) length = 0.0_wp
  end function flat_length

  !> The foil's section.
  pure function chain_section(chain) result(section)
    type(bump_chain_type), intent(in) :: chain
    type(section_type) :: section
    real(wp), parameter :: shear_factor = 5.0_wp/6.0_wp !! as the shells'
    real(wp) :: shear_modulus

    associate (e => chain%youngs_modulus, nu => chain%poissons_ratio, t => chain%thickness)
      section%bending = 1.0_wp/bending_stiffness(e, nu, t)
      if (chain%inextensible) return
      shear_modulus = 0.5_wp*e/(1.0_wp + nu)
      section%membrane = (1.0_wp - nu**2)/(e*t)
      section%shear = 1.0_wp/(shear_factor*shear_modulus*t)
    end associate
  end function chain_section

  !> Stiffness of all displacements, fixed ones included.
  pure function chain_stiffness(chain, freedoms) result(stiffness)
    type(bump_chain_type), intent(in) :: chain
    type(freedoms_type), intent(in) :: freedoms
    real(wp), allocatable :: stiffness(:, :)
    real(wp) :: left(6, 6), right(6, 6), flat(4, 4)
    integer :: i, number(6)

    associate (l => chain%half_length, h => chain%height)
      left = left_arch_stiffness(l, h, bump_radius(l, h), bump_half_angle(l, h), &
                                 chain_section(chain))
    end associate
    right = right_arch_stiffness(left)
    if (flat_length(chain) > 0.0_wp) flat = flat_stiffness(flat_length(chain), chain_section(chain))
    allocate (stiffness(freedoms%total, freedoms%total), source=0.0_wp)
    do i = 1, chain%bumps
      number(4:) = freedoms%crest(i) + [0, 1, 2]
      number(:3) = [freedoms%foot(i - 1), freedoms%rise(1, i), freedoms%turn(1, i)]
      stiffness(number, number) = stiffness(number, number) + left
      number(:3) = [freedoms%foot(i), freedoms%rise(2, i), freedoms%turn(2, i)]
      stiffness(number, number) = stiffness(number, number) + right
      if (i == chain%bumps .or. .not. flat_length(chain) > 0.0_wp) cycle
      number(:4) = [freedoms%rise(2, i), freedoms%turn(2, i), freedoms%rise(1, i + 1), &
                    freedoms%turn(1, i + 1)]
      stiffness(number(:4), number(:4)) = stiffness(number(:4), number(:4)) + flat
    end do
  end function chain_stiffness

  !> Sorts the displacements: where friction acts, and which follow from these. The rest is fixed. A
  !> chain that nothing supports along x is fixed at its first foot for the while.
  pure subroutine sort_freedoms(chain, freedoms, rubbing, inner)
    type(bump_chain_type), intent(in) :: chain
    type(freedoms_type), intent(in) :: freedoms
    integer, allocatable, intent(out) :: rubbing(:) !! feet, then crests
    integer, allocatable, intent(out) :: inner(:)   !! rising
    logical :: rubs(freedoms%total), moves(freedoms%total)
    integer :: i

    moves = .false.
    moves(freedoms%foot) = .true.
    do i = 1, chain%bumps
      moves(freedoms%turn(:, i)) = .true.
      moves(freedoms%crest(i) + [0, 1, 2]) = .true.
    end do
    if (chain%clamped_start) moves([freedoms%foot(0), freedoms%turn(1, 1)]) = .false.
    rubs = .false.
    if (chain%friction_sleeve > 0.0_wp) rubs(freedoms%foot) = moves(freedoms%foot)
    if (chain%friction_top > 0.0_wp) rubs(freedoms%crest) = .true.
    if (.not. any(rubs)) moves(freedoms%foot(0)) = .false.
    rubbing = [pack(freedoms%foot, rubs(freedoms%foot)), pack(freedoms%crest, rubs(freedoms%crest))]
    inner = pack([(i, i=1, freedoms%total)], moves .and. .not. rubs)
  end subroutine sort_freedoms

  !> Inner displacements under the load with the rubbing ones fixed (column 1), and what a unit of
  !> each of these takes from them (the further columns).
  pure subroutine eliminate(stiffness, load, rubbing, inner, response)
    real(wp), intent(in) :: stiffness(:, :), load(:)
    integer, intent(in) :: rubbing(:), inner(:)
    real(wp), allocatable, intent(out) :: response(:, :) !! (inner, 1 + rubbing)
    logical :: solved

    allocate (response(size(inner), 1 + size(rubbing)))
    response(:, 1) = load(inner)
    response(:, 2:) = stiffness(inner, rubbing)
    call solve_positive(stiffness(inner, inner), response, solved)
    if (.not. solved) error stop 'the stiffness of a chain of bumps is not positive definite'
  end subroutine eliminate

  !> The chain as its frictional contacts see it. Corners and crests are the normal forces: the two
  !> corners of a flat press on the sleeve for its foot, the load presses the crests.
  pure function condensed_contacts(chain, freedoms, stiffness, load, rubbing, inner, response) &
                                   result(contacts)
    type(bump_chain_type), intent(in) :: chain
    type(freedoms_type), intent(in) :: freedoms
    real(wp), intent(in) :: stiffness(:, :), load(:)
    integer, intent(in) :: rubbing(:), inner(:)
    real(wp), intent(in) :: response(:, :) !! of `eliminate`
    type(coulomb_contacts_type) :: contacts
    integer, allocatable :: rises(:)
    integer :: owner(freedoms%total), i, corners

    contacts%floating = .not. chain%clamped_start
    contacts%stiffness = stiffness(rubbing, rubbing) - &
      matmul(stiffness(rubbing, inner), response(:, 2:))
    contacts%load = load(rubbing) - matmul(stiffness(rubbing, inner), response(:, 1))
    owner = 0
    owner(rubbing) = [(i, i=1, size(rubbing))]
    contacts%owner = [(owner(freedoms%foot(i - 1)), owner(freedoms%foot(i)), i=1, chain%bumps), &
                      owner(freedoms%crest)]
    contacts%friction = spread(chain%friction_sleeve, 1, size(rubbing))
    contacts%friction(pack(owner(freedoms%crest), owner(freedoms%crest) > 0)) = chain%friction_top
    rises = reshape(freedoms%rise, [2*chain%bumps])
    corners = size(rises)
    contacts%normal_load = [matmul(stiffness(rises, inner), response(:, 1)), &
                            -load(freedoms%crest + 1)]
    allocate (contacts%normal_stiffness(size(contacts%owner), size(rubbing)), source=0.0_wp)
    contacts%normal_stiffness(:corners, :) = stiffness(rises, rubbing) - &
      matmul(stiffness(rises, inner), response(:, 2:))
  end function condensed_contacts

  !> Reads the solution off displacements and forces.
  pure subroutine read_answer(chain, freedoms, stiffness, displacement, solution)
    type(bump_chain_type), intent(in) :: chain
    type(freedoms_type), intent(in) :: freedoms
    real(wp), intent(in) :: stiffness(:, :), displacement(:)
    type(bump_chain_solution_type), intent(inout) :: solution
    real(wp) :: force(size(displacement)), middle
    integer :: n

    n = chain%bumps
    force = chain%width*matmul(stiffness, displacement)
    allocate (solution%foot_slip(0:n), solution%foot_friction(0:n), solution%foot_state(0:n))
    solution%foot_slip(:) = displacement(freedoms%foot)
    solution%foot_friction(:) = force(freedoms%foot)
    solution%crest_slip = displacement(freedoms%crest)
    solution%crest_friction = force(freedoms%crest)
    solution%crest_deflection = -displacement(freedoms%crest + 1)
    solution%corner_reaction = reshape(force(reshape(freedoms%rise, [2*n])), [2, n])
    solution%foot_state(:) = state(solution%foot_slip, chain%friction_sleeve)
    solution%crest_state = state(solution%crest_slip, chain%friction_top)
    if (chain%clamped_start) solution%foot_state(0) = is_clamped
    solution%lifted = any(solution%corner_reaction(2, :) < 0.0_wp) .or. &
                      any(solution%corner_reaction(1, 2:) < 0.0_wp)
    if (chain%clamped_start) return
    solution%lifted = solution%lifted .or. solution%corner_reaction(1, 1) < 0.0_wp
    ! Where nothing supports the chain along x, the mean of its feet's displacements is set to zero.
    if (chain%friction_sleeve > 0.0_wp .or. chain%friction_top > 0.0_wp) return
    middle = sum(solution%foot_slip)/real(n + 1, wp)
    solution%foot_slip = solution%foot_slip - middle
    solution%crest_slip = solution%crest_slip - middle
  end subroutine read_answer

  !> State of a contact.
  elemental function state(slip, friction)
    real(wp), intent(in) :: slip     !! along x [m]
    real(wp), intent(in) :: friction !! mu [1]
    integer :: state

    if (.not. friction > 0.0_wp) then
      state = glides
    else if (slip > 0.0_wp) then
      state = slips_forward
    else if (slip < 0.0_wp) then
      state = slips_back
    else
      state = sticks
    end if
  end function state
end module gfb_bump_chain
