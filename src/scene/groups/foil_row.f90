!> The list of foil models: what each is called, and what it has and can do. Whoever needs to know
!> asks the row; which row it is matters to `gfb_bearing_builder` alone, which builds it.
module gfb_foil_row
  implicit none (type, external)
  private

  !> A foil model. One that is not known, as where its word is misspelt, has none of the parts.
  type, public :: foil_row_type
    integer :: number = 0             !! place in the list; 0: it is not known
    character(len=18) :: word = ''    !! in the case file
    character(len=70) :: meaning = '' !! to the log; with bumps behind 'top foil and bumps'
    logical :: deflects = .true.      !! under the pressure
    logical :: has_top_foil = .false. !! with a mesh, a mass and edges of its own
    !> with meshes and masses of their own, which touch, rub and remember their slip
    logical :: has_bumps = .false.
    logical :: has_shells = .false.   !! in the top foil at least
    !> which can be condensed, iterated on, and stand on strips with sizes of their own
    logical :: has_shell_bumps = .false.
    logical :: is_planar = .false.    !! one cross-section stands for the whole width
    !> springs under every point of the film, with dampers and Maxwell arms beside them
    logical :: has_foundation = .false.
    logical :: has_crest_springs = .false. !! under the top foil, along lines or at points of them
    logical :: can_take_turns = .true.     !! with the film: `coupling = 'partitioned'`
    logical :: fits_sectors = .true.       !! of a thrust bearing
    !> of `&model`, for springs that the bumps give else; empty: there are no springs
    character(len=20) :: stiffness_key = ''
    !> why Young's modulus by temperature has no use; empty: it has one
    character(len=50) :: without_modulus = ''
  contains
    procedure, non_overridable :: is_known, needs_bumps
  end type foil_row_type

  type(foil_row_type), parameter, public :: foil_unknown = foil_row_type()

  type(foil_row_type), parameter, public :: foil_rigid = foil_row_type( &
    number=1, word='rigid', meaning='rigid, no structure', deflects=.false., &
    without_modulus="has no use with foil = 'rigid': nothing bends")

  type(foil_row_type), parameter, public :: foil_elastic_foundation = foil_row_type( &
    number=2, word='elastic_foundation', meaning='elastic foundation', has_foundation=.true., &
    stiffness_key='foundation_stiffness')

  type(foil_row_type), parameter, public :: foil_shell = foil_row_type( &
    number=3, word='shell', meaning='as shells in contact', has_top_foil=.true., &
    has_bumps=.true., has_shells=.true., has_shell_bumps=.true.)

  type(foil_row_type), parameter, public :: foil_beam = foil_row_type( &
    number=4, word='beam', &
    meaning='as planar beams in contact, under the axial mean of the pressure', &
    has_top_foil=.true., has_bumps=.true., is_planar=.true., fits_sectors=.false.)

  type(foil_row_type), parameter, public :: foil_plate = foil_row_type( &
    number=5, word='plate', meaning='top foil of shells on springs along the crests of bumps', &
    has_top_foil=.true., has_shells=.true., has_crest_springs=.true., can_take_turns=.false., &
    stiffness_key='crest_stiffness', &
    without_modulus="has no effect on a plate's springs in this version")

  !> Each at the place of its number.
  type(foil_row_type), parameter, public :: foil_rows(*) = &
    [foil_rigid, foil_elastic_foundation, foil_shell, foil_beam, foil_plate]

contains

  !> Whether the case file says which foil there is.
  pure logical function is_known(self) result(known)
    class(foil_row_type), intent(in) :: self !! the foil model, as far as it is known
    known = self%number > 0
  end function is_known

  !> Why keys of meshed foils have no effect; empty where they have one.
  pure function needs_bumps(self) result(words)
    class(foil_row_type), intent(in) :: self !! the foil model
    character(len=:), allocatable :: words

    words = ''
    if (self%has_bumps) return
    words = "it needs foil = 'shell' in &model, or 'beam', not '"//trim(self%word)//"'"
  end function needs_bumps
end module gfb_foil_row
