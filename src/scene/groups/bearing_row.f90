!> The list of kinds of bearings: how the shaft moves in each, what its pads are, what is usual of
!> its film, and its words. Whoever needs to know asks the row; which row it is matters to nobody.
module gfb_bearing_row
  use gfb_kinds, only: wp
  implicit none (type, external)
  private

  character(len=*), parameter :: axial_too = ', or half_angle'
  character(len=*), parameter, public :: needs_journal = "has no use with kind = 'thrust' in "// &
                                                         '&bearing'
  character(len=*), parameter, public :: needs_thrust = "needs kind = 'thrust' in &bearing"
  character(len=*), parameter :: needs_cone = 'needs half_angle in &bearing'

  !> A kind of bearing. One that is not known, as where its word is misspelt, refuses no key.
  type, public :: bearing_row_type
    integer :: number = 0           !! place in the list; 0: it is not known
    character(len=7) :: word = ''   !! `kind` in the case file
    logical :: moves_across = .true. !! the shaft, under a load across its axis
    logical :: moves_along = .false. !! under one along it
    logical :: has_sectors = .false. !! its pads are sectors of a ring, crests lie on their rays
    logical :: has_half_width = .true. !! of which the other half may be the mirror image
    logical :: ends_differ = .false. !! so that it never is
    ! what its film has where the case file does not say
    integer :: elements = 240              !! along a pad without bumps
    integer :: fewest_elements = 0         !! along a pad with bumps
    integer :: film_order = 1              !! of its elements
    real(wp) :: edge_refinement = 1.0_wp   !! in the middle over that at the edges of the width [1]
    !> Cell Peclet number of the concentric film above which SUPG is chosen [1]. Rigid journals,
    !> Lambda 0.1 to 3000, eccentricity ratio 0.9 to 0.999: below it Galerkin has the smaller error;
    !> above it both have the same error in the force, but Galerkin misses the smallest pressure by
    !> percents. The force on sectors it has better up to 7.6 of the land at the outer radius.
    real(wp) :: galerkin_limit = 2.0_wp
    !> Newton's, of a runner: as its gap closes the film's residual grows before it falls. A sweep
    !> over four loads takes 22 factorizations with them, 91 without.
    integer :: bold_steps = 0
    ! words
    character(len=1) :: gap_symbol = 'C'   !! of the size by which gaps are measured
    character(len=10) :: gap_size = 'clearance'
    character(len=11) :: no_bore = 'circle' !! over which a bore has its height
    character(len=6) :: width = 'axial'    !! the way of its rows
    character(len=1) :: coordinate = 'z'   !! along which these lie
    character(len=60) :: unknowns = 'shaft: (e_x, e_y) are unknowns'
    ! why keys of some kinds have no use; empty: they have one
    character(len=48) :: journal_keys = '', thrust_keys = '', axial_keys = '', &
                         cone_keys = needs_cone
  end type bearing_row_type

  type(bearing_row_type), parameter, public :: bearing_unknown = bearing_row_type(cone_keys='')

  type(bearing_row_type), parameter, public :: bearing_journal = bearing_row_type( &
    number=1, word='journal', thrust_keys=needs_thrust, axial_keys=needs_thrust//axial_too)

  type(bearing_row_type), parameter, public :: bearing_thrust = bearing_row_type( &
    number=2, word='thrust', moves_across=.false., moves_along=.true., has_sectors=.true., &
    has_half_width=.false., elements=64, fewest_elements=64, film_order=2, edge_refinement=9.0_wp, &
    galerkin_limit=10.0_wp, bold_steps=6, gap_symbol='h', gap_size="gap's size", &
    no_bore="pads' plane", width='radial', coordinate='r', &
    unknowns='runner: the axial gap is unknown', journal_keys=needs_journal)

  !> A journal with a half angle.
  type(bearing_row_type), parameter, public :: bearing_cone = bearing_row_type( &
    number=3, word='journal', moves_along=.true., ends_differ=.true., &
    unknowns='shaft: (e_x, e_y, e_z) are unknowns', thrust_keys=needs_thrust, cone_keys='')

  !> Each at the place of its number; those that have a word of their own come first.
  type(bearing_row_type), parameter, public :: bearing_rows(*) = &
    [bearing_journal, bearing_thrust, bearing_cone]
  integer, parameter, public :: bearing_words = 2 !! of them
end module gfb_bearing_row
